#include "triaxial/cli/triaxial_run.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "core/files/atomic_file.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/config/write_config.hpp"
#include "triaxial/realization/finished_run.hpp"
#include "triaxial/realization/given_packing.hpp"
#include "triaxial/realization/packing_files.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

// Of all tests of this subcommand.
const core::SimulationOptions test_options{.skin = 0, .ledger = true};

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

/// The sample that the run begins with; spheres that have been read are used up.
Sample first_sample(Run& run, const fs::path& out, core::Monitor& monitor,
                    core::Checkpoint& checkpoint) {
    if (!run.packing) return sample_from_nothing(run.config, out, monitor, checkpoint);
    core::SphereFile read =
        run.spheres ? *std::exchange(run.spheres, {}) : core::read_spheres(*run.packing);
    return sample_of_file(std::move(read), *run.packing, run.config, out, monitor);
}

/// The file of measured values, if it matters.
std::string field_data(const Config& config) {
    return config.field.variable == randomfield::Variable::none ? "" : config.field.data;
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

/// What an earlier run in the folder said of its packing is not true of this one's. The same words
/// are: the packing's own file, or this run was killed after it had kept them.
void drop_other_packing(const fs::path& packing, const fs::path& out) {
    const fs::path json = out / "packing.json", own = json_beside(packing);
    if (fs::exists(json) && fs::exists(own) &&
        core::read_whole_file(json) == core::read_whole_file(own))
        return;
    std::error_code ignored;
    fs::remove(json, ignored);
}

}  // namespace

Run prepare_run(const TriaxialArguments& arguments, const fs::path& checkpoint, Session& session) {
    Run run;
    run.found = arguments.checkpoints.find(checkpoint, session.monitor);
    run.packing = arguments.packing;
    run.realization = arguments.realization.value_or(0);
    run.repeats = arguments.repeats.value_or(0);
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
        run.repeats = before.value("repeats", 0);
        if (arguments.repeats && *arguments.repeats != run.repeats)
            throw InputError(
                fmt::format("--repeats = {}: the checkpoint is of {}", *arguments.repeats,
                            run.repeats == 0 ? "a single run" : fmt::format("{}", run.repeats)));
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
    nlohmann::json identity = run_identity("triaxial", run.config.solver);
    identity["config"] = asked;
    identity["used"] = run.used;
    identity["packing"] = core::json_of_bytes(run.packing.value_or(""));
    // A path may get another content.
    identity["packing_checksum"] = input_checksum(run.packing.value_or(""));
    identity["data_checksum"] = input_checksum(field_data(run.config));
    identity["realization"] = run.realization;
    identity["repeats"] = run.repeats;
    run.identity = core::json_text(identity);
    return run;
}

Sample make_sample(Run& run, Before& before, const fs::path& out, core::Monitor& monitor,
                   core::Checkpoint& checkpoint) {
    Sample sample = first_sample(run, out, monitor, checkpoint);
    before.times.packing = before.watch.lap();
    before.field = map_field(run.config, run.realization, sample);
    before.field.covariance_error = field_covariance_error(run.config);
    before.times.field = before.watch.lap();
    before.ready = true;
    return sample;
}

core::Simulation simulation_of(Sample sample, const Run& run, const kernels::KernelTable& kernels) {
    return make_simulation(std::move(sample), run.config, kernels,
                           run.packing.value_or("the packing"), test_options);
}

core::Simulation empty_simulation(const kernels::KernelTable& kernels) {
    return {core::Scene{}, kernels, test_options};
}

void keep_own_packing(const Run& run, const fs::path& out) {
    if (run.packing) drop_other_packing(*run.packing, out);
    keep_packing(out);
}

nlohmann::json write_results(const fs::path& folder, const Run& run, const TestResult& result,
                             const FieldRecord& field, const RunTimes& times,
                             const core::Simulation& simulation, int threads) {
    core::write_file_atomically(folder / "config.toml", config_text(run));
    core::write_file_atomically(folder / "curve.csv", curve_csv(result.curve));
    core::write_file_atomically(folder / "energy.csv", energy_csv(result.energies));
    write_state(folder / "state.h5", simulation);
    nlohmann::json summary = run_summary(result, field, run.config, simulation, times, threads);
    core::write_file_atomically(folder / "summary.json", summary.dump(2) + "\n");
    return summary;
}

}  // namespace grainfield::triaxial
