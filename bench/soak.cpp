// A million steps of a sample at rest, and of one that a wall presses and releases slowly: a CSV of
// what might drift (stress, energies, the ledger, memory) for tests/reliability/soak.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <unistd.h>

#include "bench/stability.hpp"
#include "bench/stressed_sample.hpp"
#include "core/drive/box.hpp"
#include "core/drive/measures.hpp"
#include "core/drive/step_control.hpp"
#include "core/files/atomic_file.hpp"
#include "packing/isotropic.hpp"
#include "triaxial/cli/argument_parser.hpp"

namespace grainfield::bench {
namespace {

// Both cases are looked at where a cycle ends.
constexpr std::int64_t cycles = 50;
// Of the height. Changes the axial stress by a per cent or so [-].
constexpr double strain_amplitude = 2e-5;
constexpr std::size_t moving_wall = 3;  // the upper one of the y axis

/// Memory of this process that is in use [KiB].
long resident() {
    std::ifstream stream("/proc/self/statm");
    long all = 0, used = 0;
    stream >> all >> used;
    return used * (::sysconf(_SC_PAGESIZE) / 1024);
}

/// Runs `steps` steps of a copy of the sample; rows of the CSV, one a cycle and one at the start.
std::string soak(const core::Simulation& still, const NamedKernels& kernels, bool cycled,
                 std::int64_t steps) {
    core::Simulation simulation = copy_of(still, *kernels.table, {.skin = 0, .ledger = true});
    const double step = core::StepControl({}).next(simulation);
    const std::int64_t period = steps / cycles;
    const double omega = 2 * std::numbers::pi / (static_cast<double>(period) * step);
    const Vec3 size = core::box_dimensions(simulation);
    std::string rows;
    double least = 0, most = 0;  // stress on the moving wall's axis within the cycle [Pa]
    const auto look = [&] {
        simulation.compute_forces(true);
        const core::Energy energy = simulation.energy();
        const double stress =
            core::mean_stress(simulation, core::box_dimensions(simulation).prod()).trace() / 3;
        rows += fmt::format("{},{},{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{},{}\n",
                            cycled ? "cycled" : "resting", kernels.name,
                            kernels::name(kernels.table->isa), simulation.steps(), stress, least,
                            most, energy.kinetic + energy.rotational,
                            energy.elastic_normal + energy.elastic_shear, energy.closing(),
                            energy.work_put_in, simulation.contacts().count(), resident());
    };
    look();
    for (std::int64_t cycle = 0; cycle < cycles; ++cycle) {
        least = most = core::axis_stress(simulation, 1);
        for (std::int64_t k = 0; k < period; ++k)
            simulation.step(step, [&] {
                const double stress = core::axis_stress(simulation, 1);
                least = std::min(least, stress);
                most = std::max(most, stress);
                // At mid-step: over a cycle the displacements add up to zero.
                const double phase = omega * step * (static_cast<double>(k) + 0.5);
                if (cycled)
                    simulation.set_wall_velocity(
                        moving_wall,
                        Vec3(0, -strain_amplitude * size.y() * omega * std::cos(phase), 0));
            });
        look();
    }
    say(fmt::format("soak: {}, {}: {} steps", cycled ? "cycled" : "resting", kernels.name, steps));
    return rows;
}

}  // namespace
}  // namespace grainfield::bench

int main(int argc, char** argv) {
    using namespace grainfield;
    triaxial::ArgumentParser parser("A million steps of a resting and of a slowly cycled sample.");
    std::filesystem::path sample = "build/bench/blocks-1x1x1-100kPa.h5", out = "build/soak.csv";
    std::int64_t steps = 1'000'000;
    parser.add("--sample", sample, "The sample (.h5); made if not there").show_default();
    parser.add("--out", out, "The CSV").show_default();
    parser.add("--steps", steps, "Of each run").show_default();
    if (const auto code = parser.parse_or_print(argc, argv)) return *code;
    try {
        const core::Simulation still = bench::settled(bench::stressed_sample(sample, {1, 1, 1}));
        std::string csv =
            "case,precision,isa,steps,mean_stress_Pa,least_axial_Pa,most_axial_Pa,"
            "kinetic_J,elastic_J,closing_J,work_put_in_J,contacts,memory_KiB\n";
        for (const bench::NamedKernels& kernels : bench::compared_kernels()) {
            if (kernels.name == "reference") continue;  // slow
            for (const bool cycled : {false, true})
                csv += bench::soak(still, kernels, cycled, steps);
        }
        core::write_file_atomically(out, csv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
