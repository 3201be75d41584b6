#pragma once
// The frame of the program: options that every subcommand has, and from exceptions to exit codes.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/monitor.hpp"
#include "triaxial/cli/argument_parser.hpp"
#include "triaxial/cli/interrupt.hpp"

namespace grainfield::triaxial {

/// What a subcommand gets besides its own arguments.
struct Session {
    const std::vector<std::string>&
        settings;            ///< of --set, in order, for load_config and load_scene
    core::Monitor& monitor;  ///< on stderr, silent with --quiet
    int threads;             ///< in use [-]
};

/// The subcommands by name. Each is registered by a function of commands.hpp:
///
///     void add_pack_command(CommandLine& line) {
///         auto arguments = std::make_shared<Arguments>();
///         ArgumentParser command = line.add("pack", "Packs ...", "grainfield pack --out P.h5",
///                                           [arguments](Session& session) { ... });
///         command.add("--out", arguments->out, "...").required();
///     }
class CommandLine {
  public:
    using Run = std::function<void(Session&)>;

    CommandLine();
    /// Adds a subcommand with --threads, --set, --quiet and the example in its help. `run` is
    /// called once everything is parsed; it reports by exceptions (core/base/errors.hpp) only. A
    /// signal ends the program at once until it calls handle_signals(OnSignal::stop_safely).
    ArgumentParser add(const std::string& name, const std::string& description,
                       const std::string& example, Run run);

    /// Parses and runs. Throws UsageError and what the subcommand throws.
    void run(int argc, const char* const* argv);

  private:
    ArgumentParser program_;
    std::map<std::string, Run, std::less<>> commands_;
    int threads_ = 0;  // 0: as OpenMP gives
    std::vector<std::string> settings_;
    std::string isa_;
    bool quiet_ = false;
};

/// The whole program. Returns the exit code: 0 done, 2 usage, config or input, 3 the simulation
/// failed, 4 a file, 130 interrupted, 1 anything else.
int run_program(int argc, const char* const* argv);

}  // namespace grainfield::triaxial
