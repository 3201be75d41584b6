// Run time against error: what precision, step and mass scaling cost and bring, over triaxial tests
// of a sample small enough to have a reference, all at one strain rate (bench/rate/run varies
// that); writes CSV files and a picture to
// bench/results/.
//
// Every run is a whole realization (isotropic compression, shear to the same strain) on one thread,
// as many at a time as there are workers.

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/accuracy_errors.hpp"
#include "bench/accuracy_picture.hpp"
#include "bench/accuracy_runs.hpp"
#include "bench/machine.hpp"
#include "core/files/atomic_file.hpp"
#include "core/kernel_choice.hpp"
#include "triaxial/cli/argument_parser.hpp"
#include "triaxial/cli/terminal_monitor.hpp"

namespace {

using namespace grainfield;
using bench::Case;
using bench::Setting;

struct Arguments {
    std::optional<std::string> out;
    std::filesystem::path sample = "build/bench/accuracy-packing.h5";
    int repeats = 4;
    int reference_repeats = 8;
    int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    bool quick = false;
    int precision = 0;  ///< runs of either precision to compare; 0: the whole plan
};

/// What is run on each series.
struct Plan {
    Setting reference;                           ///< of the ensemble
    std::vector<std::pair<Setting, int>> cases;  ///< and how often each
};

/// The default with one of its values replaced: once each through `values`.
template <class Value>
std::vector<Setting> axis(Setting start, Value Setting::*member, const std::vector<Value>& values) {
    std::vector<Setting> settings;
    for (const Value& value : values) {
        settings.push_back(start);
        settings.back().*member = value;
    }
    return settings;
}

/// The reference has a quarter of the default step. The mixed kernels are crossed in full; double
/// precision goes along each axis through the default. The plain reference kernels differ from the
/// vectors in round-off alone and run once each.
Plan full_plan(int repeats) {
    Plan plan;
    plan.reference = {.precision = core::Precision::double_, .safety = 0.2};
    const auto add = [&](const std::vector<Setting>& settings, int times) {
        for (const Setting& setting : settings) plan.cases.emplace_back(setting, times);
    };
    for (const double scaling : {1.0, 2.0, 4.0})
        add(axis({.mass_scaling = scaling}, &Setting::safety, {0.2, 0.4, 0.6, 0.8, 0.95}), repeats);
    const Setting wide{.precision = core::Precision::double_};
    add(axis(wide, &Setting::safety, {0.4, 0.8, 0.95}), repeats);
    add(axis(wide, &Setting::mass_scaling, {2.0, 4.0}), repeats);
    const Setting plain{.reference_kernels = true, .precision = core::Precision::double_};
    add(axis(plain, &Setting::safety, {0.8, 0.95}), 1);
    add(axis(plain, &Setting::mass_scaling, {4.0}), 1);
    return plan;
}

Plan quick_plan() {
    Plan plan;
    plan.reference = {.precision = core::Precision::double_, .safety = 0.4};
    for (const Setting& setting : {Setting{}, Setting{.safety = 0.95}, Setting{.mass_scaling = 4},
                                   Setting{.precision = core::Precision::double_}})
        plan.cases.emplace_back(setting, 2);
    plan.cases.emplace_back(
        Setting{.reference_kernels = true, .precision = core::Precision::double_}, 1);
    return plan;
}

/// Mixed against double precision, all else being the default.
Plan precision_plan(int repeats) {
    return {.reference = {.precision = core::Precision::double_}, .cases = {{Setting{}, repeats}}};
}

/// Difference of the means of a result, and its standard error.
void print_difference(const char* name, const bench::Deviation& mixed, const bench::Deviation& full,
                      int repeats) {
    const double error =
        std::sqrt((mixed.scatter * mixed.scatter + full.scatter * full.scatter) / repeats);
    fmt::print(
        "    {:>4}: mixed less double {:+.2f} +- {:.2f} %; one run scatters by {:.2f} and "
        "{:.2f} %\n",
        name, mixed.bias, error, mixed.scatter, full.scatter);
}

/// References first, they take longest; then repeat after repeat, so that what else the machine
/// does hits all settings alike.
std::vector<bench::Task> tasks_of(const Plan& plan, const std::vector<bench::Series>& series,
                                  int reference_repeats, int repeats) {
    std::vector<bench::Task> tasks;
    for (const bench::Series& s : series)
        for (int k = 0; k < reference_repeats; ++k) tasks.push_back({&s, plan.reference, k, {}});
    for (int k = 0; k < repeats; ++k)
        for (const bench::Series& s : series)
            for (const auto& [setting, times] : plan.cases)
                if (k < times) tasks.push_back({&s, setting, k, {}});
    return tasks;
}

Case gather(const std::vector<bench::Task>& tasks, const bench::Series& series,
            const Setting& setting) {
    Case c;
    c.series = &series;
    c.setting = setting;
    for (const bench::Task& task : tasks) {
        if (task.series != &series || task.setting != setting) continue;
        if (task.run.failure.empty())
            c.runs.push_back(&task.run);
        else
            ++c.failed;
    }
    return c;
}

void print_case(const Case& c) {
    const Setting& s = c.setting;
    const std::string name = fmt::format("{:>8} {:>9} safety {:<4} mass x{}", c.series->name,
                                         s.reference_kernels                       ? "reference"
                                         : s.precision == core::Precision::double_ ? "double"
                                                                                   : "mixed",
                                         s.safety, s.mass_scaling);
    if (c.runs.empty()) return fmt::print("{}: all {} runs broke\n", name, c.failed);
    fmt::print("{}: {:7.2f} s  peak {:+6.2f} ({:.2f}) %  E50 {:+6.2f} ({:.2f}) %  curve {:.2f} %\n",
               name, c.cpu_seconds, c.peak.bias, c.peak.scatter, c.E50.bias, c.E50.scatter,
               c.curve_of_mean);
}

void run(const Arguments& arguments) {
    triaxial::TerminalMonitor monitor(false);
    // The end lies past the peak of either series; quick runs only try everything once.
    std::vector<bench::Series> series =
        bench::make_series(arguments.sample, arguments.quick ? 0.003 : 0.02, monitor);
    if (arguments.quick) series.resize(1);
    const int precision = arguments.precision;
    const Plan plan = precision > 0     ? precision_plan(precision)
                      : arguments.quick ? quick_plan()
                                        : full_plan(arguments.repeats);
    std::vector<bench::Task> tasks =
        precision > 0 ? tasks_of(plan, series, precision, precision)
                      : tasks_of(plan, series, arguments.quick ? 2 : arguments.reference_repeats,
                                 arguments.repeats);
    bench::make_runs(tasks, arguments.workers, monitor);
    monitor.finish();

    std::vector<Case> ensembles;
    std::vector<std::vector<Case>> cases;
    for (const bench::Series& s : series) {
        fmt::print("{}: max k_n / min k_n = {:.0f}\n", s.name, s.stiffness_contrast);
        Case ensemble = gather(tasks, s, plan.reference);
        if (ensemble.runs.empty()) throw SimulationError("no run of the reference reached its end");
        const bench::Reference reference = bench::mean_of(ensemble.runs);
        bench::evaluate(ensemble, reference);
        print_case(ensemble);
        cases.push_back({ensemble});
        for (const auto& [setting, times] : plan.cases) {
            Case c = gather(tasks, s, setting);
            bench::evaluate(c, reference);
            print_case(c);
            if (precision > 0) {
                print_difference("peak", c.peak, ensemble.peak, precision);
                print_difference("E50", c.E50, ensemble.E50, precision);
            }
            cases.back().push_back(std::move(c));
        }
        ensembles.push_back(std::move(ensemble));
    }

    const std::filesystem::path folder =
        std::filesystem::path(
            arguments.out.value_or(arguments.quick ? "build/bench" : "bench/results")) /
        (bench::cpu_name() + "-" + kernels::name(core::choose_kernels({}).isa));
    std::filesystem::create_directories(folder);
    std::vector<Case> all;
    std::vector<bench::Panel> panels;
    for (std::size_t k = 0; k < series.size(); ++k) {
        all.insert(all.end(), cases[k].begin(), cases[k].end());
        panels.push_back({&series[k], cases[k], &ensembles[k]});
    }
    if (precision > 0) {
        core::write_file_atomically(folder / "accuracy_precision.csv", bench::cases_csv(all));
        return fmt::print("written to {}\n", folder.string());
    }
    core::write_file_atomically(folder / "accuracy.csv", bench::cases_csv(all));
    core::write_file_atomically(folder / "accuracy_noise.csv", bench::noise_csv(ensembles));
    core::write_file_atomically(folder / "accuracy.png", bench::accuracy_picture(panels));
    fmt::print("written to {}\n", folder.string());
}

}  // namespace

int main(int argc, char** argv) {
    triaxial::ArgumentParser parser(
        "Run time against error, over precision, step and mass scaling.");
    Arguments arguments;
    parser.add("--out", arguments.out,
               "Folder for CSV files and picture (bench/results; build/bench with --quick)");
    parser
        .add("--sample", arguments.sample,
             "The packing (.h5); made if it is not there, which takes a minute or two")
        .show_default();
    parser.add("--repeats", arguments.repeats, "Disturbed runs of each setting")
        .range(1, 100)
        .show_default();
    parser
        .add("--reference-repeats", arguments.reference_repeats,
             "Disturbed runs of the reference: its mean and the noise floor")
        .range(2, 100)
        .show_default();
    parser.add("--workers", arguments.workers, "Runs at a time, one thread each")
        .range(1, 1024)
        .show_default();
    parser
        .add("--precision", arguments.precision,
             "Nothing but so many disturbed runs in mixed and as many in double precision, "
             "with the difference of their means")
        .range(2, 1000);
    parser.add_flag("--quick", arguments.quick, "A smoke test: few settings, little strain");
    if (const auto code = parser.parse_or_print(argc, argv)) return *code;
    try {
        run(arguments);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
