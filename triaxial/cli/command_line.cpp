#include "triaxial/cli/command_line.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/memory_limit.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/standard_streams.hpp"
#include "triaxial/cli/terminal_monitor.hpp"
#include "triaxial/config/load_config.hpp"

namespace grainfield::triaxial {
namespace {

constexpr int most_threads = 1024;

constexpr const char* footer =
    "Exit codes: 0 done; 2 bad usage, config or input; 3 the simulation failed; 4 a file could "
    "not be read or written; 130 interrupted; 1 anything else.\n"
    "Example:\n  grainfield field --realizations 3 --out field.csv\n"
    "'grainfield SUBCOMMAND --help' tells more of each, with an example.";

void add_commands(CommandLine& line) {
    add_pack_command(line);
    add_field_command(line);
    add_triaxial_command(line);
    add_montecarlo_command(line);
    add_report_command(line);
    add_simulate_command(line);
    add_convert_command(line);
    add_info_command(line);
}

/// `--set a=1 b=2` would take b=2 for the name of a file.
void require_one_setting_each(const std::vector<std::string>& words) {
    for (std::size_t k = 1; k < words.size(); ++k) {
        const bool joined = words[k].starts_with("--set=");
        const std::size_t next = k + (joined ? 1 : 2);
        if ((!joined && words[k] != "--set") || next >= words.size()) continue;
        const std::string& word = words[next];
        std::error_code ignored;
        if (!word.starts_with('-') && word.find('=') != std::string::npos &&
            word.find('=') < word.find('/') && !std::filesystem::exists(word, ignored))
            throw UsageError(fmt::format(
                "{}: there is no such file, and --set takes one key.path=value: give --set again "
                "for each key",
                word));
    }
}

int fail(int code, std::string_view message) {
    write_log(fmt::format("grainfield: {}\n", message));
    return code;
}

}  // namespace

CommandLine::CommandLine()
    : program_("Uncertainty of soils by random fields and the discrete element method.",
               "grainfield") {
    program_.set_footer(footer);
    program_.add_version("--version", "grainfield " GRAINFIELD_VERSION);
}

ArgumentParser CommandLine::add(const std::string& name, const std::string& description,
                                const std::string& example, Run run) {
    ArgumentParser command = program_.add_subcommand(name, description);
    command.set_footer("Example:\n  " + example);
    command.add("--threads", threads_, "Threads to use (default: all that OpenMP gives)")
        .range(1, most_threads);
    command.add("--set", settings_, "key.path=value: a config key to override, again for each key")
        .one_value_each_time();
    command.add("--isa", isa_,
                "Instruction set: auto, scalar, avx2 or avx512; short for solver.isa");
    command.add_flag("--quiet", quiet_, "No progress on stderr, errors only");
    commands_[name] = std::move(run);
    return command;
}

void CommandLine::run(int argc, const char* const* argv) {
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (!first.empty() && !first.starts_with('-') && !commands_.contains(first)) {
        std::string names;
        for (const auto& [name, command] : commands_) names += (names.empty() ? "" : ", ") + name;
        throw InputError(fmt::format("'{}' is no subcommand; allowed: {}", first, names));
    }
    require_one_setting_each({argv, argv + argc});
    if (!program_.parse(argc, argv)) return;  // --help, --version
    if (program_.chosen().empty()) {
        write_log(program_.help() + "\n");
        throw InputError("a subcommand is needed");
    }
    if (threads_ == 0) threads_ = std::min(omp_get_max_threads(), most_threads);
    omp_set_num_threads(threads_);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads_));
    handle_signals(OnSignal::end_at_once);
    // Results wait in the buffer until the last line of progress is off the terminal.
    std::setvbuf(stdout, nullptr, _IOFBF, std::size_t{1} << 16);
    TerminalMonitor monitor(quiet_);
    if (!isa_.empty()) settings_.push_back("solver.isa=" + isa_);
    Session session{settings_, monitor, threads_};
    commands_.at(program_.chosen())(session);
    monitor.finish();
    flush_results();
}

void note_unused_settings(const Session& session) {
    if (session.settings.empty()) return;
    (void)load_config(std::nullopt, session.settings);
    session.monitor.note("--set has no effect here: this subcommand reads no config");
}

int run_program(int argc, const char* const* argv) {
    open_standard_streams();
    ignore_write_signals();
    CommandLine line;
    add_commands(line);
    try {
        line.run(argc, argv);
        return 0;
    } catch (const UsageError& error) {
        return fail(2, fmt::format("{} (see 'grainfield --help')", error.what()));
    } catch (const InputError& error) {
        return fail(2, error.what());
    } catch (const SimulationError& error) {
        return fail(3, error.what());
    } catch (const FileError& error) {
        return fail(4, error.what());
    } catch (const Interrupted& error) {
        return fail(130, error.what());
    } catch (const std::bad_alloc&) {
        return fail(2, fmt::format("memory ran out: allowed is what fits the {:.3g} GB there are; "
                                   "lower packing.blocks, --realizations or the number of runs "
                                   "side by side (--abreast)",
                                   1e-9 * core::memory_of_process()));
    } catch (const std::exception& error) {
        return fail(1, fmt::format("unexpected: {}", error.what()));
    }
}

}  // namespace grainfield::triaxial
