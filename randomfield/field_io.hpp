#pragma once
// Realizations as files, .csv and .h5 (docs/interface.md, "Files").

#include <cstdint>
#include <filesystem>

#include "core/base/monitor.hpp"
#include "randomfield/block_field.hpp"

namespace grainfield::randomfield {

/// What the columns of a property that is not random hold.
struct DeterministicValues {
    double friction_angle = 0.6;    ///< [rad]
    double normal_stiffness = 9e8;  ///< [Pa]
};

/// InputError unless fields are written in the format of the file's suffix.
void require_field_suffix(const std::filesystem::path& path);

/// Writes the realizations 0 ... count - 1 by the file's suffix:
/// .csv  header realization,i,j,k,G,friction_angle,normal_stiffness, a row a cell, x fastest;
///       numbers are the shortest that read back as the same double. One field in memory.
/// .h5   datasets G, friction_angle, normal_stiffness (and G_stiffness where both are random) of
///       shape [count][nz][ny][nx]; cell_size and correlation_length [3] in metres; attributes
///       cells (nx, ny, nz) and seed. All fields in memory.
/// The file appears whole or not at all. InputError for another suffix, count 0 or more than fits
/// the memory, FileError where it cannot be written, Interrupted where the monitor says so.
void write_fields(const std::filesystem::path& path, const FieldGenerator& generator,
                  std::uint64_t count, const DeterministicValues& deterministic);
void write_fields(const std::filesystem::path& path, const FieldGenerator& generator,
                  std::uint64_t count, const DeterministicValues& deterministic,
                  core::Monitor& monitor);

}  // namespace grainfield::randomfield
