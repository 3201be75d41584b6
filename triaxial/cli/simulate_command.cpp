// `simulate`: any scene of spheres and plane walls.

#include <fmt/format.h>

#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/terminal_monitor.hpp"
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
    "or, where the simulation fails or is interrupted, state.h5 alone.\n";

struct Arguments {
    std::string scene, out;
};

void run_simulate(const Arguments& arguments, Session& session) {
    const SceneFile scene = load_scene(arguments.scene, session.settings);
    const SceneSummary s =
        run_scene(scene, arguments.scene, arguments.out, session.threads, session.monitor);
    print_row("particles, walls", fmt::format("{}, {}", s.particles, s.walls));
    print_row("contacts at the end", fmt::format("{}", s.contacts));
    print_row("time, steps", fmt::format("{:.6g} s, {}", s.time, s.steps));
    print_row("time step", fmt::format("{:.6g} s", s.time_step));
    print_row("energy closing error", fmt::format("{:.2e}", s.energy_closing_error));
    print_row("solver", fmt::format("{}, {}, {} threads", s.isa, s.precision, s.threads));
    print_row("wall time", fmt::format("{}, {:.3g} particle steps/s", duration_text(s.wall_seconds),
                                       s.particle_steps_per_second));
    print_row("state hash", s.state_hash);
    print_row("written", arguments.out);
}

}  // namespace

void add_simulate_command(CLI::App& app, CommandLine& line) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App& command =
        line.add(app, "simulate",
                 "Runs a scene of spheres and plane walls: trajectories, energies, contacts.",
                 "grainfield simulate scene.toml --out run --set time.end=0.1",
                 [arguments](Session& session) { run_simulate(*arguments, session); });
    command.footer(std::string(files_text) + command.get_footer());
    command.add_option("scene", arguments->scene, "Scene (TOML)")->required();
    command.add_option("--out", arguments->out, "Folder for the results, made where it is missing")
        ->required();
}

}  // namespace grainfield::triaxial
