#pragma once
// The samples that the runs of a campaign start from, each made once: packings, and from them
// samples at their isotropic stress with the deterministic properties of the spheres.

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/base/monitor.hpp"
#include "core/files/sphere_file.hpp"
#include "triaxial/campaign/inputs.hpp"
#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::triaxial {

class Starts {
  public:
    /// Keeps them in folder/packings and folder/starts. With `packing`, all runs start from that
    /// file instead of packings of their own.
    Starts(std::filesystem::path folder, std::optional<std::filesystem::path> packing);

    /// Makes the start of these inputs, or reads it where it is there; other processes that want
    /// the same wait. One that is damaged is made again. Uses all threads. A sample that cannot be
    /// made is remembered by its reason. Throws what reading and writing throw, and Interrupted.
    void prepare(const Inputs& start, core::Monitor& monitor);

    /// A prepared start. Throws SimulationError with the reason if it cannot be made.
    const Sample& of(const Inputs& start) const;
    /// Spheres of the largest start [-].
    std::size_t largest() const;

  private:
    struct Start {
        Sample sample;
        std::string failure;  // empty: none
    };
    std::pair<core::SphereFile, std::filesystem::path> packing_of(const Config& config,
                                                                  core::Monitor& monitor);
    Start make(const Config& config, const std::filesystem::path& file, core::Monitor& monitor);

    std::filesystem::path folder_;
    std::optional<std::filesystem::path> packing_;
    std::map<std::string, Start> starts_;  // by the hash of its inputs
};

}  // namespace grainfield::triaxial
