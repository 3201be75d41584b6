#include "triaxial/campaign/starts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

#include "core/base/errors.hpp"
#include "core/files/folder.hpp"
#include "core/kernel_choice.hpp"
#include "packing/isotropic.hpp"
#include "triaxial/campaign/file_lock.hpp"
#include "triaxial/realization/packing_files.hpp"
#include "triaxial/realization/run_files.hpp"
#include "triaxial/realization/sample.hpp"

namespace grainfield::triaxial {
namespace {

namespace fs = std::filesystem;

/// Waits until no other process makes this file.
FileLock lock_of(const fs::path& file, core::Monitor& monitor) {
    bool waits = false;
    return FileLock::wait_for(fs::path(file).replace_extension(".lock"), [&] {
        if (!std::exchange(waits, true)) monitor.begin("waiting for " + file.string());
        if (monitor.stop_requested()) throw Interrupted("stopped by the user");
    });
}

/// A file of the folder, if it can be read: what is damaged is made again.
std::optional<core::SphereFile> whole(const fs::path& file, const Config& config,
                                      core::Monitor& monitor) {
    if (!fs::exists(file)) return std::nullopt;
    const auto made_again = [&](const std::exception& error) {
        monitor.note(fmt::format("{}; it is made again", error.what()));
        return std::nullopt;
    };
    try {
        core::SphereFile read = read_packing(file, config);
        std::ignore = sample_of(read, file);
        return read;
    } catch (const FileError& error) {
        return made_again(error);
    } catch (const InputError& error) {
        return made_again(error);
    }
}

}  // namespace

Starts::Starts(fs::path folder, std::optional<fs::path> packing)
    : folder_(std::move(folder)), packing_(std::move(packing)) {
    core::create_folder(folder_ / "packings");
    core::create_folder(folder_ / "starts");
}

/// The packing that a config starts from, made if need be, and its file.
std::pair<core::SphereFile, fs::path> Starts::packing_of(const Config& config,
                                                         core::Monitor& monitor) {
    if (packing_) return {read_packing(*packing_, config), *packing_};
    const Inputs inputs = packing_inputs(config);
    const fs::path file = folder_ / "packings" / (inputs.hash + ".h5");
    const FileLock lock = lock_of(file, monitor);
    // The .json comes last.
    if (fs::exists(json_beside(file)))
        if (auto read = whole(file, config, monitor)) return {std::move(*read), file};
    pack_into(file, inputs.config, monitor);
    return {read_packing(file, config), file};
}

Starts::Start Starts::make(const Config& config, const fs::path& file, core::Monitor& monitor) {
    const FileLock lock = lock_of(file, monitor);
    if (auto read = whole(file, config, monitor)) return {sample_of(std::move(*read), file), {}};
    auto [spheres, packing] = packing_of(config, monitor);
    // What the spheres bring themselves would be lost on the way: these runs start from here.
    if (spheres.has_normal_stiffness || spheres.has_friction_angle)
        return {sample_of(std::move(spheres), packing), {}};
    core::Simulation simulation =
        make_simulation(sample_of(std::move(spheres), packing), config,
                        core::choose_kernels(config.solver), packing.string());
    core::Driver driver(simulation, config.time, monitor);
    monitor.begin("isotropic compression");
    packing::compress_isotropically(driver, config.triaxial.confining_stress);
    write_state(file, simulation, "start");
    return {sample_of(read_packing(file, config), file), {}};
}

void Starts::prepare(const Inputs& start, core::Monitor& monitor) {
    if (starts_.contains(start.hash)) return;
    try {
        starts_[start.hash] =
            make(start.config, folder_ / "starts" / (start.hash + ".h5"), monitor);
    } catch (const SimulationError& error) {
        starts_[start.hash] = {{}, error.what()};
    }
}

std::size_t Starts::largest() const {
    std::size_t most = 0;
    for (const auto& [hash, start] : starts_) most = std::max(most, start.sample.spheres.size());
    return most;
}

const Sample& Starts::of(const Inputs& start) const {
    const Start& made = starts_.at(start.hash);
    if (!made.failure.empty())
        throw SimulationError("the sample that it starts from: " + made.failure);
    return made.sample;
}

}  // namespace grainfield::triaxial
