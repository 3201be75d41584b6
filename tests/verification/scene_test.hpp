#pragma once
// Runs a committed scene as `grainfield simulate` does and reads its files as a user would.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "core/scene/scene.hpp"
#include "tests/verification/record.hpp"
#include "triaxial/config/scene_file.hpp"

namespace grainfield::verify {

/// What solver.isa and solver.precision select.
struct SolverCase {
    std::string name;
    core::SolverOptions options;
    bool here;       ///< false where this machine cannot run it
    double epsilon;  ///< relative round-off of one force or displacement [-]
};
inline std::ostream& operator<<(std::ostream& out, const SolverCase& c) {
    return out << c.name;
}

/// Scalar in double precision is the reference.
std::vector<SolverCase> solver_cases();

struct Motion {
    Vec3 x, v, w;  ///< [m], [m/s], [rad/s]
};
struct Contact {
    int i, j;                           ///< wall W is -1-W [-]
    double overlap, normal, stiffness;  ///< [m], [N], [N/m]
    Vec3 shear;                         ///< on i [N]
};

/// A scene's parameters and what its run wrote.
struct SceneResult {
    triaxial::SceneFile file;
    core::Scene start;
    std::vector<double> time;                   ///< of the states [s]
    std::vector<std::vector<Motion>> states;    ///< [time][sphere]
    std::vector<Contact> contacts;              ///< at the end
    std::vector<std::array<double, 9>> energy;  ///< rows of energy.csv [s], [J]
    nlohmann::json summary;

    std::size_t size() const { return start.spheres.size(); }
    Motion first(std::size_t i) const;  ///< as the sphere file gives it
    const Motion& last(std::size_t i) const { return states.back()[i]; }
    double step() const { return *file.step; }                              ///< [s]
    double radius(std::size_t i) const { return start.spheres.radius[i]; }  ///< [m]
    double mass(std::size_t i) const;                                       ///< [kg]
    /// Eq. (4) of Tran et al. between two spheres, and between a sphere and a wall [N/m].
    double pair_stiffness(std::size_t i, std::size_t j) const;
    double wall_stiffness(std::size_t i, std::size_t wall) const;
    double effective_mass(std::size_t i, std::size_t j) const;       ///< [kg]
    double lambda() const { return file.particle.stiffness_ratio; }  ///< k_s/k_n [-]
    double energy_sum(std::size_t row) const;                        ///< of the eight columns [J]
};

class SceneTest : public testing::TestWithParam<SolverCase> {
  protected:
    void SetUp() override;
    static triaxial::SceneFile load(const std::string& scene);
    /// Runs the scene, changed or not, with the case's kernels.
    SceneResult run(triaxial::SceneFile file, const std::string& scene) const;
    SceneResult run(const std::string& scene) const { return run(load(scene), scene); }
    const std::string& kernel() const { return GetParam().name; }
    bool is_mixed() const { return GetParam().options.precision == core::Precision::mixed; }
    /// Tolerance of a result that round-off reaches `operations` times over [-].
    double roundoff(double operations) const { return operations * GetParam().epsilon; }
};

}  // namespace grainfield::verify

#define GRAINFIELD_FOR_ALL_SOLVERS(suite)                                             \
    INSTANTIATE_TEST_SUITE_P(Scenes, suite,                                           \
                             ::testing::ValuesIn(grainfield::verify::solver_cases()), \
                             [](const auto& test_info) { return test_info.param.name; })
