// Numerical stability of the solver, measured: what `dev bench` writes to bench/results/.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <string>

#include "bench/machine.hpp"
#include "bench/stability.hpp"
#include "bench/stressed_sample.hpp"

namespace {

using namespace grainfield;

struct Part {
    std::string name;
    void (*run)(const bench::StabilityRun&);
};
const std::array<Part, 5> parts = {{{"step", bench::largest_stable_step},
                                    {"overlap", bench::start_overlaps},
                                    {"collisions", bench::collisions},
                                    {"rest", bench::long_rest},
                                    {"rate", bench::strain_rates}}};

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Largest stable step, overlaps at the start, long rest, and strain rates.");
    std::filesystem::path out = "bench/results", samples = "build/bench";
    std::string only;
    bench::StabilityRun run;
    app.add_option("--out", out, "Folder for the results")->capture_default_str();
    app.add_option("--sample", samples, "Folder of the two samples (.h5); made if not there")
        ->capture_default_str();
    app.add_option("--only", only, "One part: step, overlap, collisions, rest or rate")
        ->check(CLI::IsMember({"step", "overlap", "collisions", "rest", "rate"}));
    app.add_flag("--quick", run.quick, "A smoke test: few cases, few steps");
    CLI11_PARSE(app, argc, argv);
    try {
        run.small = bench::stressed_sample(samples / "blocks-1x1x1-100kPa.h5", {1, 1, 1});
        run.large = bench::stressed_sample(samples / "blocks-2x4x2-100kPa.h5", {2, 4, 2});
        run.folder = out / (bench::cpu_name() + "-" + kernels::name(bench::double_kernels().isa));
        std::filesystem::create_directories(run.folder);
        for (const Part& part : parts)
            if (only.empty() || only == part.name) part.run(run);
        fmt::print("written to {}\n", run.folder.string());
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
