#include "tests/report/run_fixture.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "core/files/sphere_file.hpp"

namespace grainfield::triaxial::fixture {
namespace {

using nlohmann::ordered_json;

constexpr double peak_strain = 0.0112, bed_height = 3.0, unit_weight = 15300, K0 = 0.46;

double peak_stress(const FixtureOptions& o) {
    const double sine = std::sin(o.friction_angle);
    return 2 * o.confining_stress * sine / (1 - sine);
}

/// q(e) = peak x (2 u^a)/(1 + u^2a), u = e/e_peak: zero at the start, the peak at u = 1.
double deviator_stress(const FixtureOptions& o, double strain) {
    const double u = std::pow(strain / peak_strain, 0.85);
    return peak_stress(o) * 2 * u / (1 + u * u);
}

/// From q(e) above: half the peak is where u + 1/u = 4.
double secant_modulus(const FixtureOptions& o) {
    return 0.5 * peak_stress(o) / (peak_strain * std::pow(2 - std::sqrt(3.0), 1 / 0.85));
}

std::string curve_csv(const FixtureOptions& o) {
    std::string text =
        "axial_strain,deviator_stress_Pa,axial_stress_Pa,lateral_stress_x_Pa,lateral_stress_z_Pa,"
        "volumetric_strain,unbalanced_force_ratio,time_s,contacts\n";
    constexpr int rows = 420;
    for (int i = 0; i <= rows; ++i) {
        const double e = 0.021 * i / rows;
        const double q = deviator_stress(o, e) * (1 + (i == 0 ? 0 : 0.004 * std::sin(0.9 * i)));
        const double off = 0.0012 * std::sin(0.23 * i) + 0.004 * std::exp(-i / 12.0);
        const double volumetric = 0.0016 * (1 - std::exp(-e / 0.002)) - 0.21 * e * e / 0.011;
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", e, q, q + o.confining_stress,
                            o.confining_stress * (1 + off),
                            o.confining_stress * (1 - 0.7 * off * std::cos(0.1 * i)), volumetric,
                            0.002 + 0.001 * std::sin(i), 10 * e, 175000 - 40 * i);
    }
    return text;
}

/// Work grows, most of it lost to friction and damping; 1e-3 J are missing at the end.
std::string energy_csv() {
    std::string text =
        "time_s,kinetic_J,rotational_J,elastic_normal_J,elastic_shear_J,friction_work_J,"
        "damping_work_J,external_work_J,gravity_J\n";
    for (int i = 0; i <= 40; ++i) {
        const double work = 2.5 * i, lost = 25e-6 * i;
        text += fmt::format("{},{},{},{},{},{},{},{},0\n", 0.005 * i, 0.01 * work, 0.01 * work,
                            0.2 * work, 0.05 * work, 0.5 * work, 0.23 * work - lost, -work);
    }
    return text;
}

ordered_json packing_json() {
    const std::vector<double> sieves{0.010, 0.020, 0.040, 0.100, 0.160, 0.200};
    const std::vector<double> target{0, 0, 31.47, 90.93, 99.64, 100};
    ordered_json grading{{"sieve_diameter_m", sieves},
                         {"target_passing_percent", target},
                         {"achieved_passing_percent", {0.0, 0.0, 31.3, 91.6, 100.0, 100.0}}};
    std::vector<double> diameter, passing;
    for (int i = 0; i <= 60; ++i) {
        const double d = 0.020 * std::pow(0.128 / 0.020, i / 60.0);
        diameter.push_back(d);
        passing.push_back(d < 0.04 ? 31.3 * (d - 0.02) / 0.02
                                   : std::min(100.0, 31.3 + 60.3 * (d - 0.04) / 0.06));
    }
    passing.back() = 100;
    grading["achieved_curve"] = {{"diameter_m", diameter}, {"passing_percent", passing}};
    ordered_json profile;
    for (int i = 0; i < 24; ++i) {
        const double depth = bed_height * (i + 0.5) / 24;
        const double v = unit_weight * depth;
        profile["depth_m"].push_back(depth);
        profile["vertical_Pa"].push_back(v * (1 + 0.01 * std::sin(3.0 * i)));
        profile["horizontal_x_Pa"].push_back(K0 * v * (1 + 0.03 * std::sin(2.0 * i)));
        profile["horizontal_z_Pa"].push_back(K0 * v * (1 + 0.03 * std::cos(2.0 * i)));
        profile["theory_vertical_Pa"].push_back(v);
        profile["theory_horizontal_Pa"].push_back(K0 * v);
    }
    return {{"particles", 151632},
            {"porosity", 0.4003},
            {"block_spheres", 351},
            {"coordination_number", 2.31},
            {"mechanical_coordination_number", 4.62},
            {"rattler_fraction", 0.58},
            {"rattler_volume_fraction", 0.093},
            {"fabric_anisotropy", 0.041},
            {"vertical_stress_slope_ratio", 1.004},
            {"vertical_stress_r2", 0.99961},
            {"K0", K0},
            {"state_hash", "0f3c2a"},
            {"grading", grading},
            {"stress_profile", profile}};
}

ordered_json summary_json(const FixtureOptions& o, std::size_t particles) {
    const double q = peak_stress(o);
    const char* names[]{"deterministic", "stiffness", "friction"};
    ordered_json summary{{"case", names[static_cast<int>(o.field)]},
                         {"particles", particles},
                         {"contacts", 171234},
                         {"porosity", 0.4003},
                         {"confining_stress_Pa", o.confining_stress},
                         {"peak_deviator_stress_Pa", q},
                         {"axial_strain_at_peak", peak_strain},
                         {"E50_Pa", secant_modulus(o)},
                         {"friction_angle_rad", o.friction_angle},
                         {"peak_found", true},
                         {"failure", "peak"},
                         {"end_reason", "peak"},
                         {"steps", 6321},
                         {"time_step_s", 3.214e-5},
                         {"inertial_number", 8.1e-4},
                         {"lateral_stress_rms_error", 0.00093},
                         {"energy_closing_error", 0.00087},
                         {"shear_began_s", 0.03},
                         {"lateral_stress_max_error", 0.0026},
                         {"first_q_minimum_ratio", -0.0021},
                         {"wall_seconds",
                          {{"packing", 41.2},
                           {"settling", 183.0},
                           {"isotropic", 3.4},
                           {"shear", 12.9},
                           {"total", 240.5}}},
                         {"energy", {{"external_work_J", 1840.2}, {"friction_work_J", 1511.9}}},
                         {"particle_steps_per_second", 7.45e7},
                         {"state_hash", "9c1f0b7ad2e45513"},
                         {"isa", "avx512"},
                         {"precision", "mixed"},
                         {"threads", 2},
                         {"version", "0.1.0"},
                         {"unheard_of_key", "shown <as it is>"}};
    if (o.field != Field::none)
        summary["field"] = {{"gamma", 0.8478},
                            {"mean_ratio_cells", 0.942},
                            {"mean_ratio_expected", 0.963},
                            {"covariance_error", 0.112},
                            {"correlation_length", {10.0, 1.0, 10.0}}};
    return summary;
}

/// One block's spheres, large ones first, each at the freest of a few random places.
std::vector<std::array<double, 4>> block_spheres(int n, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform;
    const auto gap = [](const auto& a, const auto& b) {
        return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) - a[3] - b[3];
    };
    std::vector<std::array<double, 4>> spheres;
    for (int i = 0; i < n; ++i) {
        const double r = 0.0100 + 0.045 * std::pow(1 - (i + 0.5) / n, 6);
        std::array<double, 4> best{};
        double best_gap = -1;
        for (int attempt = 0; attempt < 80; ++attempt) {
            std::array<double, 4> s{0, 0, 0, r};
            for (int axis = 0; axis < 3; ++axis)
                s[axis] = 0.8 * r + (0.25 - 1.6 * r) * uniform(random);
            double least = 1;
            for (const auto& other : spheres) least = std::min(least, gap(s, other));
            if (least > best_gap) {
                best_gap = least;
                best = s;
                if (least > 0) break;
            }
        }
        spheres.push_back(best);
    }
    return spheres;
}

/// Mirror images of one block, with a property that changes from block to block in layers.
core::SphereFile sample(const FixtureOptions& o) {
    std::mt19937 random(7);
    const auto block = block_spheres(o.spheres_per_block, random);
    const auto [nx, ny, nz] = o.blocks;
    core::SphereFile file;
    core::ParticleStore& s = file.spheres;
    s.resize(block.size() * static_cast<std::size_t>(nx * ny * nz));
    std::size_t at = 0;
    for (int k = 0; k < nz; ++k) {
        for (int j = 0; j < ny; ++j) {
            for (int i = 0; i < nx; ++i) {
                const double g = std::sin(1.9 * j) + 0.6 * std::sin(0.7 * i + 0.9 * k);
                for (const auto& [x, y, z, r] : block) {
                    s.position.set(at, {0.25 * i + (i % 2 == 0 ? x : 0.25 - x),
                                        0.25 * j + (j % 2 == 0 ? y : 0.25 - y),
                                        0.25 * k + (k % 2 == 0 ? z : 0.25 - z)});
                    s.radius[at] = r;
                    s.normal_stiffness[at] = o.field == Field::stiffness ? 9e8 * std::exp(g) : 9e8;
                    s.friction_angle[at] = o.field == Field::friction ? 0.6 + 0.15 * g : 0.6;
                    s.block[at++] = {i, j, k};
                }
            }
        }
    }
    s.set_density(2600);
    file.box = core::Box{{0, 0, 0}, {0.25 * nx, 0.25 * ny, 0.25 * nz}};
    file.has_normal_stiffness = file.has_friction_angle = file.has_block = true;
    file.kind = "state";
    return file;
}

}  // namespace

ordered_json write_run(const std::filesystem::path& dir, const FixtureOptions& options) {
    std::filesystem::create_directories(dir);
    const core::SphereFile state = sample(options);
    core::write_spheres(dir / "state.h5", state);
    ordered_json summary = summary_json(options, state.spheres.size());
    write_file(dir / "summary.json", summary.dump(2));
    write_file(dir / "curve.csv", curve_csv(options));
    write_file(dir / "energy.csv", energy_csv());
    write_file(dir / "config.toml",
               "# comment with <angle> & ampersand\n[triaxial]\nconfining_stress = 100e3\n"
               "strain_rate = 0.1\nmax_axial_strain = \"auto\"\n\n[particle]\ndensity = 2600\n");
    if (options.packing) write_file(dir / "packing.json", packing_json().dump(2));
    return summary;
}

TestFolder::TestFolder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "grainfield-test-report-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
}

TestFolder::~TestFolder() {
    std::error_code ignored;
    if (getenv("GRAINFIELD_KEEP") == nullptr) std::filesystem::remove_all(path_, ignored);
}

void write_file(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::string read_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t occurrences(const std::string& text, std::string_view what) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; ++at) ++count;
    return count;
}

}  // namespace grainfield::triaxial::fixture
