// `report`: the page of a run, from what the run left in its folder.

#include <filesystem>

#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/report/report.hpp"

namespace grainfield::triaxial {
namespace {

struct Arguments {
    std::string folder;
    std::vector<std::string> companions;
};

void run_report(const Arguments& arguments, Session& session) {
    note_unused_settings(session);
    session.monitor.begin("drawing the report");
    const std::vector<std::filesystem::path> companions(arguments.companions.begin(),
                                                        arguments.companions.end());
    print_row("report", write_report(arguments.folder, companions).string());
}

}  // namespace

void add_report_command(CLI::App& app, CommandLine& line) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App& command = line.add(
        app, "report", "Makes DIR/report.html, one page with the figures of a triaxial run.",
        "grainfield report run-100kPa run-200kPa",
        [arguments](Session& session) { run_report(*arguments, session); }, OnSignal::end_at_once);
    command.add_option("dir", arguments->folder, "Folder of a triaxial run")->required();
    command.add_option(
        "more", arguments->companions,
        "Folders of runs at other confining stresses, for a common failure envelope");
}

}  // namespace grainfield::triaxial
