// `triaxial`: one realization, from a packing (or from nothing) to the report.

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/stopwatch.hpp"
#include "core/drive/step_control.hpp"
#include "core/files/atomic_file.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/text_file.hpp"
#include "core/kernel_choice.hpp"
#include "core/state/section_of.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/resumable_run.hpp"
#include "triaxial/cli/run_lock.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/config/write_config.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/realization/given_packing.hpp"
#include "triaxial/realization/packing_files.hpp"
#include "triaxial/realization/run_files.hpp"
#include "triaxial/realization/sample.hpp"
#include "triaxial/report/report.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

struct TriaxialArguments {
    std::optional<std::string> config;
    std::optional<std::string> packing;
    std::optional<std::int64_t> realization;
    std::string out;
    CheckpointArguments checkpoints;
};

/// The sample of a file; where there is a packing.json, it will follow into the run's folder.
Sample sample_of_file(core::SphereFile read, const fs::path& path, const Config& config,
                      const fs::path& out, core::Monitor& monitor) {
    core::SphereFile file = packing_for_test(std::move(read), path, config);
    for (const std::string& note : file.notes)
        monitor.note(fmt::format("{}: {}", path.string(), note));
    if (fs::exists(json_beside(path)) && file.kind == "packing")
        core::write_file_atomically(out / "packing.part.json",
                                    core::read_whole_file(json_beside(path)));
    return sample_of(std::move(file), path);
}

Sample sample_from_nothing(const Config& config, const fs::path& out, core::Monitor& monitor,
                           core::Checkpoint& checkpoint) {
    packing::Packing packed = pack_into(packing_in_progress(out), config, monitor, &checkpoint);
    return {std::move(packed.spheres), packed.box};
}

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
    print_row("steps", fmt::format("{} isotropic, {} shear, {:.2f} us each", r.isotropic_steps,
                                   r.shear_steps, 1e6 * r.mean_step));
    print_row("ended because", end_in_words(r.end_reason));
    const core::Energy& energy = r.energies.back().energy;
    print_row("energy",
              fmt::format("{:.4g} J put in, {:.4g} J net, {:.4g} J friction, {:.4g} J damping; the "
                          "sum closes to {:.2g} % of the work put in",
                          energy.work_put_in, energy.external_work, energy.friction_work,
                          energy.damping_work, 100 * r.energy_closing_error));
}

/// A run to begin or to go on with.
struct Run {
    Config config;
    std::string used;  // the config as resolved, before "auto" got its meaning
    nlohmann::json identity;
    std::optional<core::FoundCheckpoint> found;
    std::optional<std::string> packing;
    std::optional<core::SphereFile> spheres;  // of the packing, where they have been read
    std::int64_t realization = 0;
};

/// A fixed step that the contacts at the end do not allow; empty: it is automatic, or short enough.
std::string step_warning(core::Simulation& simulation, const core::TimeOptions& time) {
    if (!time.step || time.mass_scaling > 1) return {};
    simulation.compute_forces();
    core::StepControl control(time);
    (void)control.next(simulation);
    return control.exceeded_text();
}

/// The file of measured values, if it matters.
std::string field_data(const Config& config) {
    return config.field.variable == randomfield::Variable::none ? "" : config.field.data;
}

/// What was asked for, completed by the checkpoint where the run resumes.
Run prepare_run(const TriaxialArguments& arguments, const fs::path& checkpoint, Session& session) {
    Run run;
    run.found = arguments.checkpoints.find(checkpoint, session.monitor);
    run.packing = arguments.packing;
    run.realization = arguments.realization.value_or(0);
    if (run.realization < 0)
        throw InputError(
            fmt::format("--realization = {}: must be a whole number >= 0", run.realization));
    std::string asked;
    if (run.found) {
        asked = write_config(resumed_config(*run.found, arguments.config, session.settings));
        const auto before = nlohmann::json::parse(run.found->identity);
        run.used = before.value("used", asked);
        run.config = parse_config(run.used, run.found->file.string());
        run.config.solver = resumed_solver(*run.found, "triaxial", run.config.solver);
        const std::string packing = core::bytes_of_json(before.at("packing"));
        if (arguments.packing.value_or(packing) != packing)
            throw InputError(fmt::format("--packing = {}: the checkpoint is of \"{}\"",
                                         *arguments.packing, packing));
        if (arguments.realization && before.at("realization") != run.realization)
            throw InputError(fmt::format("--realization = {}: the checkpoint is of {}",
                                         run.realization,
                                         before.at("realization").get<std::int64_t>()));
        if (!packing.empty()) run.packing = packing;
        check_input(*run.found, "packing_checksum", packing);
        check_input(*run.found, "data_checksum", field_data(run.config));
        run.realization = before.at("realization");
    } else {
        const auto [config, given] = load_given_config(arguments.config, session.settings);
        asked = write_config(config);
        run.config = config;
        if (run.packing) {
            run.spheres = core::read_spheres(*run.packing);
            core::check_spheres(run.spheres->spheres, *run.packing, run.spheres->lines);
            run.config = config_of_packing(*run.spheres, *run.packing, config, given);
        }
        run.used = write_config(run.config);
    }
    run.identity = run_identity("triaxial", run.config.solver);
    run.identity["config"] = asked;
    run.identity["used"] = run.used;
    run.identity["packing"] = core::json_of_bytes(run.packing.value_or(""));
    // A path may get another content.
    run.identity["packing_checksum"] = input_checksum(run.packing.value_or(""));
    run.identity["data_checksum"] = input_checksum(field_data(run.config));
    run.identity["realization"] = run.realization;
    return run;
}

/// What was done before the test.
struct Before {
    bool ready = false;  // the sample stands in the simulation
    core::Stopwatch watch;
    RunTimes times;
    FieldRecord field;  // but for the field itself

    template <class Archive>
    void serialize(Archive& archive) {
        using core::bytes;
        archive(ready, watch, bytes(times), bytes(field.variable), field.realization, field.gamma,
                field.covariance_error, field.mean_ratio_expected, field.mean_ratio_cells);
    }
};

/// The sample that the run begins with; spheres that have been read are used up.
Sample first_sample(Run& run, const fs::path& out, core::Monitor& monitor,
                    core::Checkpoint& checkpoint) {
    if (!run.packing) return sample_from_nothing(run.config, out, monitor, checkpoint);
    core::SphereFile read =
        run.spheres ? *std::exchange(run.spheres, {}) : core::read_spheres(*run.packing);
    return sample_of_file(std::move(read), *run.packing, run.config, out, monitor);
}

core::Simulation begin_test(Run& run, Before& before, const kernels::KernelTable& kernels,
                            const fs::path& out, core::Monitor& monitor,
                            core::Checkpoint& checkpoint) {
    const core::SimulationOptions options{.skin = 0, .ledger = true};
    if (before.ready) return {core::Scene{}, kernels, options};
    Sample sample = first_sample(run, out, monitor, checkpoint);
    before.times.packing = before.watch.lap();
    before.field = map_field(run.config, run.realization, sample);
    before.field.covariance_error = field_covariance_error(run.config);
    before.times.field = before.watch.lap();
    before.ready = true;
    return make_simulation(std::move(sample), run.config, kernels,
                           run.packing.value_or("the packing"), options);
}

/// The config as it was used. Where the sample came from a file that does not say how it was made,
/// the keys of its making are none of its.
std::string config_text(const Run& run) {
    if (!run.packing) return run.used;
    return fmt::format(
        "# Sample: {}. What [packing] and [grading] say is true of it as far as it is known;\n"
        "# seed, gravity, spheres and grading only of packings of grainfield.\n{}",
        core::json_text(core::json_of_bytes(fs::path(*run.packing).filename().string())), run.used);
}

/// What an earlier run in the folder said of its packing is not true of this one's.
void drop_other_packing(const fs::path& packing, const fs::path& out) {
    std::error_code ignored;
    const fs::path json = out / "packing.json";
    if (!fs::equivalent(json_beside(packing), json, ignored)) fs::remove(json, ignored);
}

void run_triaxial(const TriaxialArguments& arguments, Session& session) {
    const fs::path out = arguments.out;
    const fs::path checkpoint_file = out / "checkpoint.bin";
    const RunLock lock = RunLock::of_folder(out);
    Run run = prepare_run(arguments, checkpoint_file, session);
    const Config& config = run.config;
    check_field_data(config);
    const kernels::KernelTable& kernels = core::choose_kernels(config.solver);
    core::Checkpoint checkpoint(checkpoint_file, core::json_text(run.identity),
                                arguments.checkpoints.every);
    if (run.found) {
        checkpoint.resume(*run.found);
    } else {
        CheckpointArguments::begin_anew(checkpoint_file, session.monitor);
        drop_packing_in_progress(out);
    }
    handle_signals(OnSignal::stop_safely);
    ResumableRun resumable(session.monitor, failed_state_file(out), checkpoint);

    Before before;
    const auto section =
        core::section_of(&checkpoint, "run", [&](auto& archive) { archive(before); });
    core::Simulation simulation =
        resumable.run([&] { return begin_test(run, before, kernels, out, resumable, checkpoint); });
    const TestResult result =
        resumable.run([&] { return run_test(simulation, config, resumable, &checkpoint); });
    const RunTimes& times = before.times;
    const FieldRecord& field = before.field;
    clear_earlier_run(out);
    if (run.packing) drop_other_packing(*run.packing, out);
    keep_packing(out);
    core::write_file_atomically(out / "config.toml", config_text(run));
    core::write_file_atomically(out / "curve.csv", curve_csv(result.curve));
    core::write_file_atomically(out / "energy.csv", energy_csv(result.energies));
    write_state(out / "state.h5", simulation);
    const nlohmann::json summary =
        run_summary(result, field, config, simulation, times, session.threads);
    core::write_file_atomically(out / "summary.json", summary.dump(2) + "\n");
    const fs::path report = write_report(out);
    checkpoint.remove();

    print_row("spheres", fmt::format("{}, {} contacts when shear began",
                                     simulation.spheres().size(), result.contacts));
    if (const std::string warning = step_warning(simulation, config.time); !warning.empty())
        print_row("warning", warning);
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
    command.add("--out", arguments->out, "Folder for the results").required().take_last();
    arguments->checkpoints.add_to(command);
}

}  // namespace grainfield::triaxial
