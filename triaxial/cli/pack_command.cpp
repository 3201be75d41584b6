// `pack`: one block, its mirror images, settled; P.h5 and P.json.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "core/files/json_text.hpp"
#include "core/files/sphere_file.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/resumable_run.hpp"
#include "triaxial/cli/run_lock.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/config/write_config.hpp"
#include "triaxial/realization/packing_files.hpp"

namespace grainfield::triaxial {
namespace {

struct PackArguments {
    std::optional<std::string> config;
    std::string out;
    CheckpointArguments checkpoints;
};

void print_packing(const packing::Packing& p) {
    print_row("spheres",
              fmt::format("{} ({} in a block)", p.spheres.size(), p.block.spheres.size()));
    print_row("diameters scaled by", fmt::format("{:.5f}", p.block.grading.scale));
    const std::vector<double>& diameters = p.block.grading.diameter;
    print_row(
        "largest grain",
        fmt::format("{:.2f} of the block's smallest side; the ten largest of {} hold {:.0f} % "
                    "of the mass",
                    p.block.largest_grain(), diameters.size(),
                    100 * packing::mass_share_of_largest(diameters, 10)));
    const auto achieved =
        packing::achieved_passing(p.block.grading.diameter, p.grading.sieve_diameter);
    for (std::size_t k = 0; k < achieved.size(); ++k)
        print_row(
            k == 0 ? "grading (by mass)" : "",
            fmt::format("{:6.1f} mm: {:6.2f} % passing, target {:6.2f} %",
                        1e3 * p.grading.sieve_diameter[k], achieved[k], p.grading.passing[k]));
    print_row("block",
              fmt::format("{:.4g} x {:.4g} x {:.4g} m, mean stress {:.0f} Pa, compacted with "
                          "friction {:.3f} rad",
                          p.block.size.x(), p.block.size.y(), p.block.size.z(), p.block.mean_stress,
                          p.block.compaction_friction_angle));
    print_row("its state", p.block.range.text(p.block.porosity));
    print_row("porosity", fmt::format("{:.4f}", p.porosity));
    print_row("coordination number",
              fmt::format("{:.3f}, {:.3f} mechanical: without the {:.1f} % of the spheres ({:.1f} "
                          "% of the volume) with "
                          "fewer than two contacts",
                          p.fabric.coordination_number, p.fabric.mechanical_coordination_number,
                          100 * p.fabric.rattler_fraction, 100 * p.fabric.rattler_volume_fraction));
    print_row("fabric anisotropy", fmt::format("{:.4f}", p.fabric.anisotropy));
    print_row("vertical stress", fmt::format("{:.4f} of gamma * depth, R2 = {:.5f}",
                                             p.profile.slope_ratio, p.profile.r2));
    print_row("K0", fmt::format("{:.3f}", p.profile.K0));
    print_row("state hash", p.state_hash);
}

void run_pack(const PackArguments& arguments, Session& session) {
    const auto beside = [&](const char* suffix) {
        return std::filesystem::path(arguments.out).replace_extension(suffix);
    };
    core::require_sphere_suffix(arguments.out);
    const RunLock lock = RunLock::of_file(arguments.out);
    const auto found = arguments.checkpoints.find(beside(".checkpoint.bin"), session.monitor);
    Config config = found ? resumed_config(*found, arguments.config, session.settings)
                          : load_config(arguments.config, session.settings);
    const std::string asked = write_config(config);
    if (found) config.solver = resumed_solver(*found, "pack", config.solver);
    nlohmann::json identity = run_identity("pack", config.solver);
    identity["config"] = asked;
    core::Checkpoint checkpoint(beside(".checkpoint.bin"), core::json_text(identity),
                                arguments.checkpoints.every);
    if (found) checkpoint.resume(*found);
    if (!found) CheckpointArguments::begin_anew(checkpoint.file(), session.monitor);
    handle_signals(OnSignal::stop_safely);
    ResumableRun resumable(session.monitor, beside(".failed.h5"), checkpoint);
    const packing::Packing packed =
        resumable.run([&] { return pack(config, resumable, &checkpoint); });
    write_packing(arguments.out, packed, packed.seconds());
    std::error_code ignored;
    std::filesystem::remove(beside(".failed.h5"), ignored);  // of an earlier run
    checkpoint.remove();
    print_packing(packed);
    print_row("time", fmt::format("{:.1f} s", packed.seconds()));
    print_row("written", fmt::format("{}, {}", arguments.out, json_beside(arguments.out).string()));
}

}  // namespace

void add_pack_command(CommandLine& line) {
    auto arguments = std::make_shared<PackArguments>();
    ArgumentParser command = line.add(
        "pack",
        "Packs one block to the grading and porosity, clones it by mirror flips and lets the "
        "sample settle under gravity. Writes the spheres and, beside them, a .json.",
        "grainfield pack --set packing.spheres=351 --out P.h5",
        [arguments](Session& session) { run_pack(*arguments, session); });
    command.add("config", arguments->config, "Config (TOML); without one the case of Tran et al.");
    command.add("--out", arguments->out, "File to write: .h5 (ParaView), .csv, .data or .txt")
        .required();
    arguments->checkpoints.add_to(command);
}

}  // namespace grainfield::triaxial
