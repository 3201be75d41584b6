// `montecarlo`: a campaign of realizations over cases.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "core/base/errors.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/sphere_file.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/campaign/campaign.hpp"
#include "triaxial/campaign/progress.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/realization/failure.hpp"
#include "triaxial/realization/given_packing.hpp"
#include "triaxial/realization/sample.hpp"

namespace grainfield::triaxial {
namespace {

struct MonteCarloArguments {
    std::string config;
    std::string out;
    std::string shard;
    std::optional<std::string> packing;
    std::optional<std::int32_t> abreast;
    std::vector<std::string> merge;
};

/// "I/N".
Shard parse_shard(const std::string& text) {
    if (text.empty()) return {};
    std::string_view rest = text;
    std::int64_t shard = 0, shards = 0;
    const bool numbers =
        core::parse_number(core::next_field(rest, '/'), shard) && core::parse_number(rest, shards);
    if (!numbers || shard < 1 || shard > shards || shards > 1000000)
        throw InputError(fmt::format(
            "--shard = {}: I/N is expected, two whole numbers with 1 <= I <= N <= 1000000", text));
    return {static_cast<std::int32_t>(shard), static_cast<std::int32_t>(shards)};
}

/// A line a case: how many rows, and the means.
void print_cases(const std::vector<CampaignCase>& cases, const std::map<RowPlace, Row>& rows) {
    std::size_t widest = 0;  // longer names than that stand out of the column
    for (const CampaignCase& one : cases)
        widest = std::max(widest, std::min<std::size_t>(one.name.size(), 60));
    for (std::size_t c = 0; c < cases.size(); ++c) {
        std::size_t failed = 0, without_peak = 0, with_warnings = 0;
        std::vector<double> peak, E50;
        for (auto at = rows.lower_bound({c, 0}); at != rows.end() && at->first.case_index == c;
             ++at) {
            failed += at->second.failed ? 1u : 0u;
            if (at->second.failed) continue;
            without_peak += at->second.failure == failure_name(Failure::strain_limit) ? 1u : 0u;
            with_warnings += at->second.warnings.empty() ? 0u : 1u;
            peak.push_back(at->second.peak_deviator_stress / 1e3);
            E50.push_back(at->second.E50 / 1e6);
        }
        std::string text = fmt::format("{} of {} done, {} failed", E50.size(),
                                       cases[c].config.montecarlo.realizations, failed);
        if (!E50.empty())
            text += fmt::format("; means with 95 % intervals: peak {} kPa, E50 {} MPa",
                                mean_text(peak), mean_text(E50));
        if (without_peak > 0) text += fmt::format("; {} without a peak", without_peak);
        if (with_warnings > 0) text += fmt::format("; {} with a warning", with_warnings);
        print_row(fmt::format("{:<{}}", cases[c].name, widest), text);
    }
}

/// Every case is one of the packing that all of them start from.
void adapt_to_packing(std::vector<CampaignCase>& cases, const std::string& path,
                      core::Monitor& monitor) {
    const core::SphereFile file = core::read_spheres(path);
    core::check_spheres(file.spheres, path, file.lines);
    for (const std::string& note : file.notes) monitor.note(fmt::format("{}: {}", path, note));
    for (CampaignCase& one : cases) try {
            one.config = config_of_packing(file, path, one.config, one.given);
        } catch (const InputError& error) {
            throw InputError(fmt::format("case \"{}\": {}", one.name, error.what()));
        }
}

void run_montecarlo(const MonteCarloArguments& arguments, Session& session) {
    std::vector<CampaignCase> cases = load_campaign(arguments.config, session.settings);
    if (arguments.packing) adapt_to_packing(cases, *arguments.packing, session.monitor);
    const Shard shard = parse_shard(arguments.shard);
    for (const CampaignCase& one : cases) check_field_data(one.config);
    for (const CampaignCase& one : cases)
        if (one.config.field.variable == randomfield::Variable::none &&
            one.config.montecarlo.realizations > 1)
            session.monitor.note(fmt::format(
                "case \"{}\": field.variable is \"none\": all of its realizations are the same run",
                one.name));
    CampaignFolder folder(arguments.out, cases, arguments.packing, shard);
    if (!arguments.merge.empty()) {
        std::size_t taken = 0;
        for (const std::string& other : arguments.merge) taken += folder.merge(other);
        print_row("rows taken over", fmt::format("{}", taken));
        print_cases(cases, folder.write_results());
    } else {
        handle_signals(OnSignal::stop_safely);
        const CampaignResult result =
            run_campaign(folder, {session.threads, arguments.abreast}, session.monitor);
        print_row("rows computed", fmt::format("{}", result.computed));
        print_cases(cases, result.rows);
    }
    print_row("results", (folder.path() / "results.csv").string());
}

}  // namespace

void add_montecarlo_command(CommandLine& line) {
    auto arguments = std::make_shared<MonteCarloArguments>();
    ArgumentParser command = line.add(
        "montecarlo",
        "Runs a campaign: every case of the config, [montecarlo] realizations of each. Stop it, "
        "kill it, start it again: it goes on.",
        "grainfield montecarlo campaign.toml --out campaign\n"
        "  grainfield montecarlo campaign.toml --out campaign --shard 3/16",
        [arguments](Session& session) { run_montecarlo(*arguments, session); });
    command.add("config", arguments->config, "Config (TOML) of the campaign").required();
    command.add("--out", arguments->out, "Folder of the campaign").required().take_last();
    command.add("--shard", arguments->shard,
                "I/N: only the I-th of N parts; parts may share a folder");
    command.add("--packing", arguments->packing,
                "Packing that all runs start from, any file of spheres; without one each case's is "
                "made");
    command
        .add("--abreast", arguments->abreast,
             "Runs at a time, which share the threads (default: one a thread, of samples of "
             "100,000 spheres and more one for two threads)")
        .range(1, 1024);
    command
        .add("--merge", arguments->merge,
             "Folders of the same campaign whose rows are taken over; computes nothing")
        .one_or_more_values();
}

}  // namespace grainfield::triaxial
