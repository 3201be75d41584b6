// `simulate` against closed forms: what is written is what the physics says.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

using testing::HasSubstr;

// Spheres of R = 0.1 m with Tran et al.'s material: K_n = R k/2 between two of them and with a
// wall.
constexpr double radius = 0.1;                                                           // [m]
constexpr double mass = 2600 * 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;  // [kg]
constexpr double stiffness = 0.5 * radius * 9e8;                                         // [N/m]
constexpr double gravity = 9.81;                                                         // [m/s2]

const std::string damped = "[damping]\nforce = 0.2\nmoment = 0.2\n";

std::string times(const std::string& step, const std::string& end, const std::string& interval) {
    return "[time]\nstep = " + step + "\nend = " + end + "\n[output]\ninterval = " + interval +
           "\n";
}

TEST(Simulate, FreeFallWithLocalDamping) {
    const Workplace place;
    const Outcome run = place.simulate(
        "x,y,z,radius\n1,2,3,0.1\n", scene_head + times("1e-3", "0.1", "1e-2") + falling + damped);
    ASSERT_EQ(run.code, 0) << run.err;
    const Table t = read_table(place.read("run/trajectory.csv"));
    EXPECT_EQ(t.header, "time_s,id,x,y,z,vx,vy,vz,wx,wy,wz");
    ASSERT_EQ(t.rows.size(), 11U);
    for (std::size_t r = 0; r < t.rows.size(); ++r) {
        const double time = 0.01 * static_cast<double>(r);
        // Local damping takes a fifth of the load; the scheme is exact for constant acceleration,
        // so that only the sum's round-off is left.
        EXPECT_NEAR(t.at(r, "time_s"), time, 1e-15);
        EXPECT_NEAR(t.at(r, "vy"), -0.8 * gravity * time, 1e-13);
        EXPECT_NEAR(t.at(r, "y"), 2 - 0.4 * gravity * time * time, 1e-13);
        EXPECT_EQ(t.at(r, "x"), 1);
    }
}

TEST(Simulate, HeadOnImpactGivesTheSpeedBack) {
    const Workplace place;
    const Outcome run =
        place.simulate("x,y,z,radius,vx,vy,vz\n0,0,0,0.1,0.5,0,0\n0.2001,0,0,0.1,-0.5,0,0\n",
                       scene_head + times("1e-6", "2e-3", "1e-6"));
    ASSERT_EQ(run.code, 0) << run.err;
    const Table t = read_table(place.read("run/trajectory.csv"));
    ASSERT_EQ(t.rows.size(), 2 * 2001U);
    double overlap = 0;
    double contact_time = 0;
    for (std::size_t r = 0; r < t.rows.size(); r += 2) {
        const double now = 2 * radius - (t.at(r + 1, "x") - t.at(r, "x"));
        overlap = std::max(overlap, now);
        contact_time += now > 0 ? 1e-6 : 0;
        EXPECT_NEAR(t.at(r, "vx") + t.at(r + 1, "vx"), 0, 1e-12) << "momentum";
    }
    // Discrete entry and exit: an error of first order in the step over the contact time (1e-3) in
    // the times, of second order in the energy.
    const double half_period = std::sqrt(0.5 * mass / stiffness);
    EXPECT_NEAR(t.rows.back()[5], 0.5, 1e-5);
    EXPECT_NEAR(overlap, half_period, 1e-4 * half_period);
    EXPECT_NEAR(contact_time, std::numbers::pi * half_period, 2e-6);
}

TEST(Simulate, RestingSphereAndItsContact) {
    const Workplace place;
    const Outcome run =
        place.simulate("x,y,z,radius\n0,0.1,0,0.1\n",
                       scene_head + times("1e-5", "0.2", "0.1") + falling + damped + floor_wall);
    ASSERT_EQ(run.code, 0) << run.err;
    const Table c = read_table(place.read("run/contacts.csv"));
    EXPECT_EQ(c.header,
              "i,j,overlap_m,normal_force_N,shear_force_x_N,shear_force_y_N,shear_force_z_N,"
              "normal_stiffness_N_m");
    ASSERT_EQ(c.rows.size(), 1U);
    EXPECT_EQ(c.at(0, "i"), 0);
    EXPECT_EQ(c.at(0, "j"), -1);
    // The overlap is a difference of lengths of 0.1 m: round-off 1e-17 m of 2e-6 m.
    EXPECT_NEAR(c.at(0, "overlap_m"), mass * gravity / stiffness,
                1e-9 * mass * gravity / stiffness);
    EXPECT_NEAR(c.at(0, "normal_force_N"), mass * gravity, 1e-9 * mass * gravity);
    EXPECT_EQ(c.at(0, "shear_force_x_N"), 0);
    EXPECT_DOUBLE_EQ(c.at(0, "normal_stiffness_N_m"), stiffness);
}

TEST(Simulate, ContactsNameWallsAndSpheres) {
    const Workplace place;
    // Second wall far to the side; a stack on the floor, pressed together by 1e-6 m.
    const Outcome run =
        place.simulate("x,y,z,radius\n0,0.099999,0,0.1\n0,0.299998,0,0.1\n",
                       scene_head + times("1e-6", "1e-6", "1") +
                           "[[wall]]\npoint = [-9, 0, 0]\nnormal = [1, 0, 0]\n" + floor_wall);
    ASSERT_EQ(run.code, 0) << run.err;
    const Table c = read_table(place.read("run/contacts.csv"));
    ASSERT_EQ(c.rows.size(), 2U);
    EXPECT_EQ(c.at(0, "i"), 0);
    EXPECT_EQ(c.at(0, "j"), 1);
    EXPECT_EQ(c.at(1, "i"), 0);
    EXPECT_EQ(c.at(1, "j"), -2);
    for (const std::size_t row : {0, 1})
        EXPECT_NEAR(c.at(row, "overlap_m"), 1e-6, 1e-8);  // the upper sphere moved by F h2/m
}

TEST(Simulate, EnergyColumnsAddUpToAConstant) {
    const Workplace place;
    // An oblique, spinning, damped impact on a frictional wall that comes along.
    const Outcome run = place.simulate(
        "x,y,z,radius,vx,vy,vz,wx,wy,wz\n0,0.1005,0,0.1,1,-1,0,0,0,5\n0.15,0.26,0,0.1,0,-1,0,0,3,"
        "0\n",
        scene_head + times("2e-7", "4e-3", "1e-5") + falling + damped + floor_wall +
            "velocity = [0, 0.5, 0]\n");
    ASSERT_EQ(run.code, 0) << run.err;
    const Table e = read_table(place.read("run/energy.csv"));
    EXPECT_EQ(e.header,
              "time_s,kinetic_J,rotational_J,elastic_normal_J,elastic_shear_J,friction_work_J,"
              "damping_work_J,external_work_J,gravity_J");
    ASSERT_EQ(e.rows.size(), 401U);
    const auto sum = [](const std::vector<double>& row) {
        return std::accumulate(row.begin() + 1, row.end(), 0.0);
    };
    for (const auto& row : e.rows)
        // Contacts that open or close within a step cost their share of it: (omega h)^2 = 2e-7.
        EXPECT_NEAR(sum(row), sum(e.rows[0]), 1e-5 * e.at(0, "kinetic_J")) << "at " << row[0];
    const std::size_t last = e.rows.size() - 1;
    for (const char* column : {"friction_work_J", "damping_work_J"})
        EXPECT_GT(e.at(last, column), 0.01) << column;
    EXPECT_LT(e.at(last, "external_work_J"), -0.01) << "minus what the wall put in";
    EXPECT_LT(place.json("run/summary.json").at("energy_closing_error"), 1e-5);
}

TEST(Simulate, MassesOfAFileCountAndOthersAreTheConfigs) {
    const Workplace place;
    const std::string data =
        "title\n\n1 atoms\n1 atom types\n-1 1 xlo xhi\n-1 1 ylo yhi\n-1 1 zlo zhi\n\nAtoms # "
        "sphere\n\n1 1 0.2 5200 0 0.5 0\n\nVelocities\n\n1 3 0 0 0 0 0\n";
    place.write("spheres.data", data);
    place.write("spheres.csv", "x,y,z,radius,vx,vy,vz\n0,0.5,0,0.1,3,0,0\n");
    for (const auto& [file, expected] :
         {std::pair{"spheres.data", 2 * mass}, std::pair{"spheres.csv", mass}}) {
        const std::string scene =
            place.write("scene.toml", "[particles]\nfile = '" + std::string(file) + "'\n" +
                                          times("1e-5", "1e-4", "1e-4") + floor_wall);
        const Outcome run = place.run({"simulate", scene, "--out", place.path(file + 8)});
        ASSERT_EQ(run.code, 0) << run.err;
        const Table e = read_table(place.read(std::string(file + 8) + "/energy.csv"));
        EXPECT_NEAR(e.at(0, "kinetic_J"), 4.5 * expected, 1e-12 * expected) << file;
    }
    place.write("spheres.csv", "x,y,z,radius,normal_stiffness\n0,0.5,0,0.1,-3\n");
    const Outcome run = place.run({"simulate", place.path("scene.toml"), "--out", place.path("x")});
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.err, HasSubstr("normal_stiffness = -3: must be > 0 Pa"));
}

TEST(Simulate, AutomaticStepHitsTheEnd) {
    const Workplace place;
    const Outcome run =
        place.simulate("x,y,z,radius\n0,0.1,0,0.1\n",
                       scene_head + times("\"auto\"", "0.0123", "0.005") + falling + floor_wall);
    ASSERT_EQ(run.code, 0) << run.err;
    const nlohmann::json summary = place.json("run/summary.json");
    EXPECT_DOUBLE_EQ(summary.at("time_s"), 0.0123);
    const Table e = read_table(place.read("run/energy.csv"));
    ASSERT_EQ(e.rows.size(), 4U) << "0, after 0.005 and 0.010, the end";
    const double step = summary.at("time_step_s");
    for (const std::size_t k : {1, 2}) {
        EXPECT_GE(e.at(k, "time_s"), 0.005 * static_cast<double>(k) - 1e-5 * step);
        EXPECT_LT(e.at(k, "time_s"), 0.005 * static_cast<double>(k) + 1.5 * step);
    }
}

TEST(Simulate, ServoHoldsItsStress) {
    const Workplace place;
    std::string scene = scene_head + times("\"auto\"", "0.2", "0.1") + damped;
    const double edge = 0.2;
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            double point[3] = {0, 0, 0};
            double normal[3] = {0, 0, 0};
            point[axis] = side * edge;
            normal[axis] = side == 0 ? 1 : -1;
            scene += "[[wall]]\npoint = [" + std::to_string(point[0]) + ", " +
                     std::to_string(point[1]) + ", " + std::to_string(point[2]) + "]\nnormal = [" +
                     std::to_string(normal[0]) + ", " + std::to_string(normal[1]) + ", " +
                     std::to_string(normal[2]) + "]\n";
            if (axis == 1 && side == 1) scene += "stress = 1e5\n";
        }
    const Outcome run = place.simulate("x,y,z,radius\n0.1,0.1,0.1,0.1\n", scene);
    ASSERT_EQ(run.code, 0) << run.err;
    const Table c = read_table(place.read("run/contacts.csv"));
    double force = 0;
    for (std::size_t r = 0; r < c.rows.size(); ++r)
        if (c.at(r, "j") == -4) force = c.at(r, "normal_force_N");
    // At rest the servo's integral has the target exactly; what is left is the decayed motion.
    EXPECT_NEAR(force, 1e5 * edge * edge, 1e-3 * 1e5 * edge * edge);
}

}  // namespace
}  // namespace grainfield::program_tests
