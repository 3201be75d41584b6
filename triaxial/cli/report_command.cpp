// `report`: the page of a run, from what the run left in its folder.

#include <fmt/format.h>

#include <filesystem>

#include "core/base/errors.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/run_lock.hpp"
#include "triaxial/report/campaign/campaign_data.hpp"
#include "triaxial/report/campaign/campaign_report.hpp"
#include "triaxial/report/repeats/repeats_data.hpp"
#include "triaxial/report/repeats/repeats_report.hpp"
#include "triaxial/report/report.hpp"
#include "triaxial/report/run_folder.hpp"

namespace grainfield::triaxial {
namespace {

struct ReportArguments {
    std::string folder;
    std::vector<std::string> companions;
};

void run_report(const ReportArguments& arguments, Session& session) {
    note_unused_settings(session);
    session.monitor.begin("drawing the report");
    const std::vector<std::filesystem::path> companions(arguments.companions.begin(),
                                                        arguments.companions.end());
    if (report::is_series(arguments.folder)) {
        if (!companions.empty())
            throw InputError(
                fmt::format("{} is the folder of repeats: it is reported alone", arguments.folder));
        const RunLock lock = RunLock::of_folder(arguments.folder);
        print_row("report", write_repeats_report(arguments.folder).string());
        return;
    }
    if (!report::is_campaign(arguments.folder)) {
        if (!std::filesystem::is_directory(arguments.folder))
            throw FileError(fmt::format("{}: no such folder", arguments.folder));
        const RunLock lock = RunLock::of_folder(arguments.folder);
        print_row("report", write_report(arguments.folder, companions).string());
        for (const auto& companion : companions) {
            const std::string difference = report::soil_difference(
                report::read_mohr_circle(arguments.folder), report::read_mohr_circle(companion));
            if (!difference.empty())
                print_row("not comparable", fmt::format("{}, left out of the envelope: {}",
                                                        companion.string(), difference));
        }
        return;
    }
    if (!companions.empty())
        throw InputError(
            fmt::format("{} is the folder of a campaign: it is reported alone", arguments.folder));
    print_row("report", write_campaign_report(arguments.folder).string());
}

}  // namespace

void add_report_command(CommandLine& line) {
    auto arguments = std::make_shared<ReportArguments>();
    ArgumentParser command = line.add(
        "report",
        "Makes DIR/report.html, one page with the figures of a triaxial run, of repeats or of a "
        "campaign.",
        "grainfield report run-100kPa run-200kPa",
        [arguments](Session& session) { run_report(*arguments, session); });
    command.add("dir", arguments->folder, "Folder of a triaxial run, of repeats or a campaign")
        .required();
    command.add("more", arguments->companions,
                "Folders of runs at other confining stresses, for a common failure envelope");
}

}  // namespace grainfield::triaxial
