#include "triaxial/cli/resumable_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "core/files/checksum.hpp"
#include "core/kernel_choice.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/config/write_config.hpp"
#include "triaxial/realization/run_files.hpp"

namespace grainfield::triaxial {
namespace {

/// First line of two texts that differs, as both have it; comments after values left out.
std::string first_difference(const std::string& here, const std::string& there) {
    std::istringstream a(here), b(there);
    std::string table, line, other;
    const auto value = [](const std::string& text) { return text.substr(0, text.find("  #")); };
    while (std::getline(a, line) && std::getline(b, other)) {
        if (line.starts_with('[')) table = line + " ";
        if (line != other)
            return fmt::format("{}{}; the checkpoint has {}", table, value(line), value(other));
    }
    return "one is longer";
}

}  // namespace

void CheckpointArguments::add_to(ArgumentParser& command) {
    command.add_flag("--resume", resume,
                     "Go on from the checkpoint that an interrupted run left; ends with the same "
                     "bits as if it had not been interrupted");
    command
        .add("--checkpoint-every", every,
             "Seconds between two checkpoints, 60 unless given; 0: only on SIGINT, SIGTERM")
        .range(0.0, 1e9);
}

std::optional<core::FoundCheckpoint> CheckpointArguments::find(const std::filesystem::path& file,
                                                               core::Monitor& monitor) const {
    if (!resume) return std::nullopt;
    std::optional<core::FoundCheckpoint> found = core::find_checkpoint(file);
    if (!found) {
        monitor.note(fmt::format("no checkpoint {}: begins anew", file.string()));
        return found;
    }
    for (const std::string& bad : found->bad) monitor.note(bad);
    monitor.note(fmt::format("goes on from {}", found->file.string()));
    return found;
}

void CheckpointArguments::begin_anew(const std::filesystem::path& file, core::Monitor& monitor) {
    if (const auto stale = core::put_checkpoint_away(file))
        monitor.note(fmt::format("begins anew; the checkpoint of an earlier run is {} now",
                                 stale->string()));
}

std::string input_checksum(const std::filesystem::path& file) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(file, ignored) ? core::checksum_of_file(file)
                                                           : std::string();
}

void check_input(const core::FoundCheckpoint& found, const char* key,
                 const std::filesystem::path& file) {
    const std::string before = nlohmann::json::parse(found.identity).value(key, std::string());
    const std::string now = input_checksum(file);
    if (!before.empty() && !now.empty() && before != now)
        throw InputError(
            fmt::format("--resume: {} is not what it was when the run of {} began; without "
                        "--resume it begins anew",
                        file.string(), found.file.string()));
}

nlohmann::json run_identity(const std::string& command, const core::SolverOptions& solver) {
    const kernels::KernelTable& kernels = core::choose_kernels(solver);
    return {{"command", command},
            {"isa", kernels::name(kernels.isa)},
            {"precision", kernels.precision}};
}

core::SolverOptions resumed_solver(const core::FoundCheckpoint& found, const std::string& command,
                                   core::SolverOptions solver) {
    const auto identity = nlohmann::json::parse(found.identity);
    if (identity.at("command") != command)
        throw InputError(fmt::format("--resume: {} is a checkpoint of `{}`", found.file.string(),
                                     identity.at("command").get<std::string>()));
    // What "auto" meant where the run began.
    if (!solver.isa) solver.isa = kernels::instruction_set(identity.at("isa").get<std::string>());
    return solver;
}

Config resumed_config(const core::FoundCheckpoint& found, const std::optional<std::string>& file,
                      std::span<const std::string> settings) {
    const std::string text = nlohmann::json::parse(found.identity).at("config");
    if (file || !settings.empty()) {
        const std::string here = write_config(load_config(file, settings));
        if (here != text)
            throw InputError(
                fmt::format("--resume: {} is of another config: here {}; leave CONFIG and --set "
                            "out to go on with that of the checkpoint",
                            found.file.string(), first_difference(here, text)));
    }
    return parse_config(text, found.file.string());
}

void ResumableRun::ended_early(const core::Simulation& simulation) {
    write_state(state_, simulation);
    state_written_ = true;
}

std::string ResumableRun::failure_text() const {
    std::string text;
    if (state_written_) text = fmt::format("; the state is in {}", state_.string());
    if (std::filesystem::exists(checkpoint_.file()))
        text += fmt::format("; the last checkpoint is {}", checkpoint_.file().string());
    return text;
}

std::string ResumableRun::interruption_text() const {
    return fmt::format("; the checkpoint is {}: the same command with --resume goes on from it",
                       checkpoint_.file().string());
}

}  // namespace grainfield::triaxial
