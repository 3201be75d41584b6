// `triaxial`: one realization, from a packing (or from nothing) to the report.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/files/sphere_checks.hpp"
#include "core/kernel_choice.hpp"
#include "core/state/section_of.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/repeated_run.hpp"
#include "triaxial/cli/run_lock.hpp"
#include "triaxial/cli/triaxial_run.hpp"
#include "triaxial/realization/failure.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/realization/given_packing.hpp"
#include "triaxial/report/report.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

/// Largest deviator stress, called what it is, and E50.
void print_strength(const CurveResults& r) {
    const std::string stress =
        fmt::format("{:.2f} kPa at {:.3f} % axial strain", r.peak_deviator_stress / 1e3,
                    100 * r.axial_strain_at_peak);
    if (r.failure == Failure::peak)
        print_row("peak deviator stress", stress);
    else if (r.failure == Failure::plateau)
        print_row("deviator stress", stress + ", a plateau");
    else
        print_row("largest deviator stress", stress + ", no peak before the end");
    std::string modulus = fmt::format("{:.2f} MPa", r.E50 / 1e6);
    if (moduli_differ(r.E50, r.smoothed_E50))
        modulus += fmt::format(", {:.2f} MPa from the smoothed curve", r.smoothed_E50 / 1e6);
    print_row("E50", modulus);
}

void print_test(const TestResult& r, const Config& config, const FieldRecord& field) {
    const double degrees = 180 / std::numbers::pi;
    print_row("confining stress",
              fmt::format("{:.1f} kPa, held within {:.3f} % (RMS), {:.3f} % at most",
                          config.triaxial.confining_stress / 1e3, 100 * r.lateral_rms_error,
                          100 * r.lateral_max_error));
    print_row("porosity",
              fmt::format("{:.4f}, {:.4f} when shear began", r.porosity, r.sheared_porosity));
    if (field.variable != randomfield::Variable::none)
        print_row("random field",
                  fmt::format("realization {}, gamma {:.4f}", field.realization, field.gamma));
    print_strength(r.results);
    print_row("friction angle", fmt::format("{:.4f} rad = {:.2f} degrees", r.results.friction_angle,
                                            r.results.friction_angle * degrees));
    print_row("inertial number", fmt::format("{:.2e}", r.inertial_number));
    if (r.shear_energy)
        print_row("up to the largest q",
                  fmt::format("{:.0f} % of the dissipated energy went into numerical damping; "
                              "kinetic over elastic energy {:.2g}",
                              100 * r.shear_energy->damping_share, r.shear_energy->kinetic_ratio));
    print_row("steps", fmt::format("{} isotropic, {} shear, {:.2f} us each", r.isotropic_steps,
                                   r.shear_steps, 1e6 * r.mean_step));
    print_row("ended because", end_in_words(r.end_reason));
    const core::Energy& energy = r.energies.back().energy;
    print_row("energy",
              fmt::format("{:.4g} J put in, {:.4g} J net, {:.4g} J friction, {:.4g} J damping; the "
                          "sum closes to {:.2g} % of the work put in",
                          energy.work_put_in, energy.external_work, energy.friction_work,
                          energy.damping_work, 100 * r.energy_closing_error));
    for (const std::string& warning : r.warnings) print_row("warning", warning);
}

void run_triaxial(const TriaxialArguments& arguments, Session& session) {
    const fs::path out = arguments.out;
    const fs::path checkpoint_file = out / "checkpoint.bin";
    const RunLock lock = RunLock::of_folder(out);
    Run run = prepare_run(arguments, checkpoint_file, session);
    const Config& config = run.config;
    check_field_data(config);
    const kernels::KernelTable& kernels = core::choose_kernels(config.solver);
    core::Checkpoint checkpoint(checkpoint_file, run.identity, arguments.checkpoints.every);
    if (run.found) {
        checkpoint.resume(*run.found);
    } else {
        CheckpointArguments::begin_anew(checkpoint_file, session.monitor);
        drop_packing_in_progress(out);
        drop_repeats_in_progress(out);
    }
    handle_signals(OnSignal::stop_safely);
    if (run.repeats > 0) return run_repeats(run, out, kernels, checkpoint, session);

    ResumableRun resumable(session.monitor, failed_state_file(out), checkpoint);
    Before before;
    const auto section =
        core::section_of(&checkpoint, "run", [&](auto& archive) { archive(before); });
    core::Simulation simulation = resumable.run([&] {
        if (before.ready) return empty_simulation(kernels);
        return simulation_of(make_sample(run, before, out, resumable, checkpoint), run, kernels);
    });
    const TestResult result =
        resumable.run([&] { return run_test(simulation, config, resumable, &checkpoint); });
    const RunTimes& times = before.times;
    const FieldRecord& field = before.field;
    clear_earlier_run(out);
    keep_own_packing(run, out);
    const nlohmann::json summary =
        write_results(out, run, result, field, times, simulation, session.threads);
    const fs::path report = write_report(out);
    checkpoint.remove();

    print_row("spheres", fmt::format("{}, {} contacts when shear began",
                                     simulation.spheres().size(), result.contacts));
    print_row("density", density_text(simulation.spheres()));
    print_test(result, config, field);
    const double total = summary["wall_seconds"]["total"];
    print_row("time",
              fmt::format(
                  "{:.1f} s: packing {:.1f}, isotropic {:.1f}, shear {:.1f}; {:.3g} sphere-steps/s",
                  total, times.packing, result.isotropic_seconds, result.shear_seconds,
                  summary["particle_steps_per_second"].get<double>()));
    print_row("solver", fmt::format("{}, {}, {} threads", kernels::name(kernels.isa),
                                    kernels.precision, session.threads));
    print_row("state hash", summary["state_hash"].get<std::string>());
    print_row("report", report.string());
}

}  // namespace

void add_triaxial_command(CommandLine& line) {
    auto arguments = std::make_shared<TriaxialArguments>();
    ArgumentParser command =
        line.add("triaxial",
                 "Runs one triaxial test: packing (made, or read), random field, isotropic "
                 "compression, shear past the peak, "
                 "report.",
                 "grainfield triaxial --packing P.h5 --set field.variable=stiffness --realization "
                 "7 --out run7",
                 [arguments](Session& session) { run_triaxial(*arguments, session); });
    command.add("config", arguments->config, "Config (TOML); without one the case of Tran et al.");
    command.add("--packing", arguments->packing,
                "Packing to start from, any file of spheres; without one it is made");
    command.add("--realization", arguments->realization,
                "Which realization of the field, 0 unless given");
    command
        .add("--repeats", arguments->repeats,
             "Runs the test so many times, from starts 1e-12 m apart: what a single run scatters "
             "by")
        .range(2, 1000);
    command.add("--out", arguments->out, "Folder for the results").required().take_last();
    arguments->checkpoints.add_to(command);
}

}  // namespace grainfield::triaxial
