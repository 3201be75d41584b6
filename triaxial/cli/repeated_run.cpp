#include "triaxial/cli/repeated_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/folder.hpp"
#include "core/files/text_file.hpp"
#include "core/state/section_of.hpp"
#include "core/state/world_state.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/realization/repeated_start.hpp"
#include "triaxial/report/repeats/repeats_data.hpp"
#include "triaxial/report/repeats/repeats_report.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

/// What the repeats share, and how far the series is.
struct Series {
    Before before;
    Sample sample;            // that each begins with, but for its shifts
    std::int32_t repeat = 0;  // at work

    template <class Archive>
    void serialize(Archive& archive) {
        using core::bytes;
        archive(before, sample.spheres, bytes(sample.box), bytes(sample.contacts), repeat);
    }
};

/// Where the results of a repeat stand until the series has all of its own.
fs::path repeat_in_progress(const fs::path& out, std::size_t k) {
    return repeat_folder(out, k) += ".part";
}

/// All repeats are there: they take the place of what an earlier run or series left in the folder.
/// What a run that was killed in here has moved already stays where it is.
void take_place(const fs::path& out, std::size_t count) {
    if (fs::exists(out / "summary.json")) {
        // Of a finished single run; else they are the user's.
        std::error_code ignored;
        for (const char* name : {"curve.csv", "energy.csv"}) fs::remove(out / name, ignored);
    }
    if (fs::exists(repeat_in_progress(out, 0))) clear_earlier_run(out);
    for (std::size_t k = 0; k < count; ++k) {
        const fs::path part = repeat_in_progress(out, k), folder = repeat_folder(out, k);
        if (!fs::exists(part)) continue;
        core::create_folder(folder);  // that of an earlier series may hold files of the user
        try {
            for (const auto& entry : fs::directory_iterator(part))
                fs::rename(entry.path(), folder / entry.path().filename());
            fs::remove(part);
        } catch (const fs::filesystem_error& error) {
            throw FileError(fmt::format("{}: its files cannot be moved to {}: {}", part.string(),
                                        folder.string(), error.code().message()));
        }
    }
}

/// The repeat at work.
std::string name_of(const Series& series, const Run& run) {
    return fmt::format("repeat {} of 0-{}", series.repeat, run.repeats - 1);
}

void run_repeat(Series& series, bool resumed, const Run& run, const fs::path& out,
                const kernels::KernelTable& kernels, core::Checkpoint& checkpoint,
                Session& session) {
    const auto number = static_cast<std::size_t>(series.repeat);
    const fs::path folder = repeat_in_progress(out, number);
    ResumableRun resumable(session.monitor, failed_state_file(folder), checkpoint,
                           name_of(series, run) + ", ");
    core::Simulation simulation =
        resumed
            ? empty_simulation(kernels)
            : simulation_of(start_of_repeat(series.sample, run.config.packing.seed, series.repeat),
                            run, kernels);
    core::create_folder(folder);  // for the state of one that fails
    const TestResult result =
        resumable.run([&] { return run_test(simulation, run.config, resumable, &checkpoint); });
    core::remove_abandoned_files(folder);
    clear_earlier_run(folder);
    // The sample was made once.
    const RunTimes times = number == 0 ? series.before.times : RunTimes{};
    write_results(folder, run, result, series.before.field, times, simulation, session.threads);
}

/// What is known of the packing stands beside every repeat, for its own report.
void hand_out_packing_json(const fs::path& out, std::size_t repeats) {
    for (std::size_t k = 0; k < repeats; ++k) {
        const fs::path copy = repeat_folder(out, k) / "packing.json";
        std::error_code ignored;
        if (fs::exists(out / "packing.json"))
            core::write_file_atomically(copy, core::read_whole_file(out / "packing.json"));
        else
            fs::remove(copy, ignored);
    }
}

void print_scatter(const report::RepeatsData& data) {
    const auto range = [](const statistics::Interval& interval, double scale, int digits) {
        return fmt::format("{:.{}g} to {:.{}g}", scale * interval.lower, digits,
                           scale * interval.upper, digits);
    };
    constexpr const char* line = "{:<31} {:>9} {:>22} {:>10} {:>8} {:>20}\n";
    write_result(fmt::format(line, "", "mean", "95 %", "deviation", "COV, %", "95 %"));
    for (const report::RepeatedQuantity& q : report::repeated_quantities) {
        const report::Scatter s = scatter_of(data, q);
        write_result(fmt::format(
            line, fmt::format("{} ({})", q.word, q.unit), fmt::format("{:.4g}", q.scale * s.mean),
            range(s.mean_interval, q.scale, 4), fmt::format("{:.3g}", q.scale * s.deviation),
            fmt::format("{:.3g}", 100 * s.variation), range(s.variation_interval, 100, 3)));
    }
}

}  // namespace

void drop_repeats_in_progress(const fs::path& out) {
    std::error_code ignored;
    for (std::size_t k = 0; fs::exists(repeat_in_progress(out, k)); ++k)
        fs::remove_all(repeat_in_progress(out, k), ignored);
}

void run_repeats(Run& run, const fs::path& out, const kernels::KernelTable& kernels,
                 core::Checkpoint& checkpoint, Session& session) {
    Series series;
    const auto section =
        core::section_of(&checkpoint, "repeats", [&](auto& archive) { archive(series); });
    // A checkpoint that has the sample was saved in the test of a repeat.
    bool resumed = series.before.ready;
    if (!resumed) {
        ResumableRun resumable(session.monitor, failed_state_file(out), checkpoint);
        series.sample = resumable.run(
            [&] { return make_sample(run, series.before, out, resumable, checkpoint); });
    }
    for (; series.repeat < run.repeats; ++series.repeat) try {
            run_repeat(series, resumed, run, out, kernels, checkpoint, session);
            resumed = false;
        } catch (const SimulationError& error) {
            throw SimulationError(name_of(series, run) + ": " + error.what());
        }
    session.monitor.begin("report");
    keep_own_packing(run, out);
    const auto count = static_cast<std::size_t>(run.repeats);
    take_place(out, count);
    hand_out_packing_json(out, count);
    const report::RepeatsData data = report::read_repeats(out, count);
    core::write_file_atomically(out / "repeats.csv", repeats_csv(data));
    core::write_file_atomically(out / "repeats.json", repeats_json(data).dump(2) + "\n");
    const fs::path page = write_repeats_report(out);
    checkpoint.remove();

    print_row("spheres", fmt::format("{}", series.sample.spheres.size()));
    print_row("repeats", fmt::format("{}, {} without a peak; start positions within {:g} m", count,
                                     data.without_peak, start_spread));
    print_scatter(data);
    print_row("report", page.string());
}

}  // namespace grainfield::triaxial
