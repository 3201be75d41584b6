#pragma once
// The writers behind field_io.hpp, one a format. Private to the module.

#include <cstdint>
#include <filesystem>
#include <string>

#include "randomfield/field_io.hpp"

namespace grainfield::randomfield {

/// Says how far the work is; Interrupted where the user asked to stop.
void report_progress(core::Monitor& monitor, std::uint64_t realization, std::uint64_t count);

/// Fills the columns that are not random with their deterministic value.
void complete(BlockField& field, const DeterministicValues& deterministic);

/// Writes to `file`, which exists; the message of a FileError names `target`.
void write_field_csv(const std::filesystem::path& file, const std::filesystem::path& target,
                     const FieldGenerator& generator, std::uint64_t count,
                     const DeterministicValues& deterministic, core::Monitor& monitor);

/// The bytes of the .h5 file.
std::string fields_as_h5(const FieldGenerator& generator, std::uint64_t count,
                         const DeterministicValues& deterministic, core::Monitor& monitor);

}  // namespace grainfield::randomfield
