// `simulate`: any scene of spheres and plane walls.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/files/checksum.hpp"
#include "core/files/json_text.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/resumable_run.hpp"
#include "triaxial/cli/run_lock.hpp"
#include "triaxial/cli/terminal_monitor.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/scene/run_scene.hpp"

namespace grainfield::triaxial {
namespace {

constexpr const char* files_text =
    "DIR gets\n"
    "  trajectory.csv  positions, velocities and spins, all of the same time\n"
    "  energy.csv      energies and works, whose sum is constant: external_work_J is minus the\n"
    "                  work that moving walls put in\n"
    "  contacts.csv    contacts at the end; wall W is j = -1-W, the shear force is that on i\n"
    "  summary.json    counts, times, how well the energies close, hash of the final state\n"
    "or, where the simulation fails, state.h5 alone (state.failed.h5 beside the files of an "
    "earlier\n"
    "run, which stay as they are); where it is interrupted, checkpoint.bin and\n"
    "the tables so far (.part), from which --resume goes on.\n";

struct SimulateArguments {
    std::string scene, out;
    CheckpointArguments checkpoints;
};

/// Checksum of all that the run is made of: scene, settings, spheres.
std::string checksum_of_inputs(const SimulateArguments& arguments, const SceneFile& scene,
                               const std::vector<std::string>& settings) {
    core::Checksum checksum;
    const auto add = [&](const std::string& text) { checksum.add(text.c_str(), text.size() + 1); };
    add(core::read_whole_file(arguments.scene));
    for (const std::string& setting : settings) add(setting);
    add(core::read_whole_file(scene.spheres));
    return core::hex_text(checksum.digest());
}

void run_simulate(const SimulateArguments& arguments, Session& session) {
    const std::filesystem::path out = arguments.out;
    const std::filesystem::path file = out / "checkpoint.bin";
    const RunLock lock = RunLock::of_folder(out);
    const auto found = arguments.checkpoints.find(file, session.monitor);
    SceneFile scene = load_scene(arguments.scene, session.settings);
    if (found) scene.solver = resumed_solver(*found, "simulate", scene.solver);
    nlohmann::json identity = run_identity("simulate", scene.solver);
    identity["inputs"] = checksum_of_inputs(arguments, scene, session.settings);
    if (found && nlohmann::json::parse(found->identity).at("inputs") != identity["inputs"])
        throw InputError(
            fmt::format("--resume: {} is of another run: {}, its spheres or --set "
                        "are not what they were",
                        found->file.string(), arguments.scene));
    core::Checkpoint checkpoint(file, core::json_text(identity), arguments.checkpoints.every);
    if (found) checkpoint.resume(*found);
    if (!found) CheckpointArguments::begin_anew(file, session.monitor);
    handle_signals(OnSignal::stop_safely);
    ResumableRun resumable(session.monitor, failed_state_file(out), checkpoint);
    const SceneSummary s = resumable.run([&] {
        return run_scene(scene, arguments.scene, out, session.threads, resumable, &checkpoint);
    });
    checkpoint.remove();
    print_row("particles, walls", fmt::format("{}, {}", s.particles, s.walls));
    print_row("density", s.density);
    print_row("contacts at the end", fmt::format("{}", s.contacts));
    print_row("time, steps", fmt::format("{:.6g} s, {}", s.time, s.steps));
    print_row("time step", fmt::format("{:.6g} s", s.time_step));
    for (const std::string& warning : s.warnings) print_row("warning", warning);
    print_row("energy closing error", fmt::format("{:.2e}", s.energy_closing_error));
    print_row("solver", fmt::format("{}, {}, {} threads", s.isa, s.precision, s.threads));
    print_row("wall time", fmt::format("{}, {:.3g} particle steps/s", duration_text(s.wall_seconds),
                                       s.particle_steps_per_second));
    print_row("state hash", s.state_hash);
    print_row("written", arguments.out);
}

}  // namespace

void add_simulate_command(CommandLine& line) {
    auto arguments = std::make_shared<SimulateArguments>();
    ArgumentParser command = line.add(
        "simulate", "Runs a scene of spheres and plane walls: trajectories, energies, contacts.",
        "grainfield simulate scene.toml --out run --set time.end=0.1",
        [arguments](Session& session) { run_simulate(*arguments, session); });
    command.set_footer(files_text + command.footer());
    command.add("scene", arguments->scene, "Scene (TOML)").required();
    command.add("--out", arguments->out, "Folder for the results, made where it is missing")
        .required();
    arguments->checkpoints.add_to(command);
}

}  // namespace grainfield::triaxial
