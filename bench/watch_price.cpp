// What looking for a broken state every so many steps costs, as a share of the steps themselves.
// Prints a line for each sample: its spheres, the time of a step and of a look, and their quotient.

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <vector>

#include "bench/stressed_sample.hpp"
#include "core/drive/driver.hpp"
#include "core/kernel_choice.hpp"
#include "triaxial/cli/argument_parser.hpp"

namespace grainfield::bench {
namespace {

/// Of all threads: who else uses the machine does not count [s].
double processor_time() {
    std::timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

void measure(const core::Scene& scene, int rounds) {
    core::Simulation simulation(scene, core::choose_kernels({}));
    simulation.compute_forces(true);
    const double step = core::StepControl({}).next(simulation);
    std::vector<double> steps, looks;
    for (int round = 0; round < rounds; ++round) {
        const double start = processor_time();
        for (std::int64_t k = 0; k < core::Driver::watch_interval; ++k)
            simulation.step(step, [] {});
        const double middle = processor_time();
        simulation.health().check();
        steps.push_back(middle - start);
        looks.push_back(processor_time() - middle);
    }
    const double interval = static_cast<double>(core::Driver::watch_interval);
    fmt::print("{} {:.4g} {:.4g} {:.4g}\n", simulation.size(), 1e3 * median(steps) / interval,
               1e3 * median(looks), 100 * median(looks) / median(steps));
}

}  // namespace
}  // namespace grainfield::bench

int main(int argc, char** argv) {
    using namespace grainfield;
    triaxial::ArgumentParser parser(
        "The price of the watch over a run: spheres, ms a step, ms a look, per cent.");
    std::filesystem::path samples = "build/bench";
    parser.add("--sample", samples, "Folder of the samples (.h5); made if not there")
        .show_default();
    if (const auto code = parser.parse_or_print(argc, argv)) return *code;
    try {
        const std::filesystem::path full = samples / "full-100kPa.h5";
        bench::measure(bench::stressed_sample(samples / "blocks-1x1x1-100kPa.h5", {1, 1, 1}), 300);
        // Minutes to pack: measured where another bench has left it.
        if (std::filesystem::exists(full)) bench::measure(bench::full_sample(full), 10);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
