// Numerical stability of the solver, measured: what `dev bench` writes to bench/results/.

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string>

#include "bench/machine.hpp"
#include "bench/stability.hpp"
#include "bench/stressed_sample.hpp"
#include "triaxial/cli/argument_parser.hpp"

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
    triaxial::ArgumentParser parser(
        "Largest stable step, overlaps at the start, long rest, and strain rates.");
    std::filesystem::path out = "bench/results", samples = "build/bench";
    std::string only;
    bench::StabilityRun run;
    parser.add("--out", out, "Folder for the results").show_default();
    parser.add("--sample", samples, "Folder of the two samples (.h5); made if not there")
        .show_default();
    parser.add("--only", only, "One part: step, overlap, collisions, rest or rate")
        .one_of({"step", "overlap", "collisions", "rest", "rate"});
    parser.add_flag("--quick", run.quick, "A smoke test: few cases, few steps");
    if (const auto code = parser.parse_or_print(argc, argv)) return *code;
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
