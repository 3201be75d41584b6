// `simulate`: any scene of spheres and plane walls.

#include <fmt/format.h>

#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/terminal_monitor.hpp"
#include "triaxial/scene/run_scene.hpp"

namespace grainfield::triaxial {
namespace {

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
    CLI::App& command = line.add(
        app, "simulate",
        "Runs a scene of spheres and plane walls. DIR gets trajectory.csv, energy.csv, "
        "contacts.csv and summary.json. The columns of energy.csv add up to a constant: "
        "external_work_J is minus the work that moving walls put in. contacts.csv names wall W as "
        "j = -1-W; its forces are those on i.",
        "grainfield simulate scene.toml --out run --set time.end=0.1",
        [arguments](Session& session) { run_simulate(*arguments, session); });
    command.add_option("scene", arguments->scene, "Scene (TOML)")->required();
    command.add_option("--out", arguments->out, "Folder for the results, made where it is missing")
        ->required();
}

}  // namespace grainfield::triaxial
