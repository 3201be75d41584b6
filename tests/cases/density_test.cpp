// The masses that a file brings count, in every subcommand, and what was used is said.

#include <gtest/gtest.h>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

class DensityOfAFile : public testing::Test {
  protected:
    std::string heavy() { return place_.write("heavy.data", lammps_text({.density = 5200})); }
    double density_of_state() {
        const core::ParticleStore s = core::read_spheres(place_.path("run/state.h5")).spheres;
        double mass = 0;
        for (const double m : s.mass) mass += m;
        return mass / s.solid_volume();
    }
    Outcome simulate(const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments{
            "simulate",
            place_.write("s.toml", "[particles]\nfile = \"heavy.data\"\n[time]\nend = 1e-4\n"),
            "--out",
            place_.path("scene"),
            "--threads",
            "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return place_.run(arguments);
    }

    Workplace place_;
};

// `triaxial` once took the config's 2600 kg/m3 without a word.
TEST_F(DensityOfAFile, IsThatOfTheTest) {
    const Outcome outcome = shear(place_, heavy());
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "5200 kg/m3")) << outcome.out;
    EXPECT_NEAR(density_of_state(), 5200, 1e-6);
    // A step in proportion to sqrt(mass): that of spheres of 2600 kg/m3 is 36.4 us.
    EXPECT_NEAR(place_.json("run/summary.json").at("time_step_s").get<double>() * 1e6, 51.3, 1.5);
    const std::string config = place_.read("run/config.toml");
    EXPECT_NEAR(std::stod(config.substr(config.find("\ndensity = ") + 11)), 5200, 1e-6);
}

TEST_F(DensityOfAFile, IsThatOfAScene) {
    heavy();
    const Outcome outcome = simulate();
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "5200 kg/m3")) << outcome.out;
}

TEST_F(DensityOfAFile, ContradictedByTheConfigIsRefused) {
    const std::vector<std::string> other{"particle.density=2600"};
    const Outcome test = shear(place_, heavy(), other);
    EXPECT_EQ(test.code, 2);
    EXPECT_TRUE(has(test.err, "whose spheres bring 5200 kg/m3")) << test.err;
    const Outcome scene = simulate({"--set", other[0]});
    EXPECT_EQ(scene.code, 2);
    EXPECT_TRUE(has(scene.err, "contradicts")) << scene.err;
    const std::string campaign =
        place_.write("c.toml",
                     "[triaxial]\nmax_axial_strain = 0.001\n[montecarlo]\nrealizations = 1\n"
                     "[montecarlo.sweep]\n\"particle.density\" = [2600, 5200]\n");
    const Outcome swept = place_.run({"montecarlo", campaign, "--packing", heavy(), "--threads",
                                      "1", "--out", place_.path("c")});
    EXPECT_EQ(swept.code, 2);
    EXPECT_TRUE(has(swept.err, "bring 5200 kg/m3")) << swept.err;
    EXPECT_EQ(shear(place_, heavy(), {"particle.density=5200"}).code, 0) << "the same";
}

TEST_F(DensityOfAFile, GoesWithItToAnotherFormatOrIsSaidToBeLost) {
    const Outcome kept = place_.run({"convert", heavy(), place_.path("P.h5")});
    ASSERT_EQ(kept.code, 0) << kept.err;
    ASSERT_EQ(shear(place_, place_.path("P.h5")).code, 0);
    EXPECT_NEAR(density_of_state(), 5200, 1e-6);
    for (const char* name : {"P.csv", "P.txt"}) {
        const Outcome lost = place_.run({"convert", heavy(), place_.path(name)});
        ASSERT_EQ(lost.code, 0) << lost.err;
        EXPECT_TRUE(has(lost.out, "masses")) << lost.out;
        ASSERT_EQ(shear(place_, place_.path(name), {"particle.density=3000"}).code, 0);
        EXPECT_NEAR(density_of_state(), 3000, 1e-6);
    }
}

TEST_F(DensityOfAFile, OfEachSphereIsItsOwn) {
    std::string text = lammps_text({.density = 5200});
    text.replace(text.find(" 5200 "), 6, " 2600 ");
    const Outcome outcome = shear(place_, place_.write("P.data", text));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "2600 to 5200 kg/m3")) << outcome.out;
}

}  // namespace
}  // namespace grainfield::case_tests
