// Results as files: the contract's keys and columns.
#include "triaxial/realization/run_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/files/sphere_file.hpp"
#include "tests/triaxial/small_test.hpp"

namespace grainfield::triaxial {
namespace {

TEST(RunFiles, SummaryCurveAndStateOfATest) {
    Sample sample = testing::dense_sample(200);
    Config config = testing::small_config(sample);
    config.triaxial.max_axial_strain = 0.001;
    config.field.variable = randomfield::Variable::friction;
    const FieldRecord field = map_field(config, 2, sample);
    const testing::FinishedTest run = testing::run(std::move(sample), config);
    const TestResult& r = run.result;
    const nlohmann::json summary =
        run_summary(r, field, config, run.simulation, {.packing = 1, .field = 0.5}, 2);
    for (const char* key : {"particles",
                            "contacts",
                            "porosity",
                            "confining_stress_Pa",
                            "peak_deviator_stress_Pa",
                            "axial_strain_at_peak",
                            "E50_Pa",
                            "friction_angle_rad",
                            "steps",
                            "time_step_s",
                            "wall_seconds",
                            "particle_steps_per_second",
                            "state_hash",
                            "isa",
                            "precision",
                            "threads",
                            "version",
                            "failure",
                            "end_reason",
                            "smoothed_peak_deviator_stress_Pa",
                            "smoothed_E50_Pa"})
        EXPECT_TRUE(summary.contains(key)) << key;
    EXPECT_EQ(summary["case"], "friction");
    EXPECT_EQ(summary["particles"], 200);
    EXPECT_EQ(summary["confining_stress_Pa"], 100e3);
    EXPECT_EQ(summary["peak_deviator_stress_Pa"], r.results.peak_deviator_stress);
    EXPECT_EQ(summary["E50_Pa"], r.results.E50);
    EXPECT_EQ(summary["steps"], r.isotropic_steps + r.shear_steps);
    EXPECT_EQ(summary["threads"], 2);
    EXPECT_EQ(summary["precision"], "double");
    EXPECT_EQ(summary["state_hash"], run.simulation.state_hash());
    EXPECT_EQ(summary["field"]["realization"], 2);
    EXPECT_FALSE(summary["peak_found"]);  // sheared a little only: q still grows
    EXPECT_EQ(summary["failure"], "strain-limit");
    EXPECT_EQ(summary["end_reason"], "asked");
    EXPECT_EQ(summary["smoothed_E50_Pa"], r.results.smoothed_E50);
    double stages = 0;
    for (const auto& [stage, seconds] : summary["wall_seconds"].items()) {
        EXPECT_GE(seconds.get<double>(), 0) << stage;
        if (stage != "total") stages += seconds.get<double>();
    }
    EXPECT_NEAR(summary["wall_seconds"]["total"], stages, 1e-9);

    const std::string csv = curve_csv(r.curve);
    EXPECT_EQ(csv.substr(0, csv.find('\n')),
              "axial_strain,deviator_stress_Pa,axial_stress_Pa,lateral_stress_x_Pa,"
              "lateral_stress_z_Pa,volumetric_strain,unbalanced_force_ratio,time_s,contacts");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
              static_cast<std::ptrdiff_t>(r.curve.size() + 1));
    // Numbers come back as they were.
    const std::string last = csv.substr(csv.rfind('\n', csv.size() - 2) + 1);
    EXPECT_EQ(std::stod(last), r.curve.back().axial_strain);
    EXPECT_EQ(std::stod(last.substr(last.find(',') + 1)), r.curve.back().deviator_stress);

    const auto path = std::filesystem::temp_directory_path() /
                      ("grainfield_state_" + std::to_string(::getpid()) + ".h5");
    write_state(path, run.simulation);
    const core::SphereFile state = core::read_spheres(path);
    std::filesystem::remove(path);
    EXPECT_EQ(state.kind, "state");
    EXPECT_EQ(state.spheres.position, run.simulation.spheres().position);
    EXPECT_EQ(state.spheres.velocity, run.simulation.spheres().velocity);
    EXPECT_EQ(state.spheres.spin, run.simulation.spheres().spin);
    EXPECT_EQ(state.spheres.friction_angle, run.simulation.spheres().friction_angle);
    EXPECT_EQ(state.spheres.block, run.simulation.spheres().block);
    ASSERT_TRUE(state.box);
    EXPECT_EQ(state.box->upper.y(), run.simulation.walls()[3].point.y());
    EXPECT_EQ(nlohmann::json::parse(state.attributes)["state_hash"], run.simulation.state_hash());
    ASSERT_TRUE(state.extra.contains("contacts"));
    EXPECT_EQ(state.extra.at("contacts").shape[0],
              static_cast<std::size_t>(run.simulation.contacts().count()));
}

}  // namespace
}  // namespace grainfield::triaxial
