#pragma once
// A folder may hold a finished run while another one works in it: until that has its own results,
// the files of the finished one stay as they are. summary.json says that a run is finished,
// repeats.json that a series of repeats is.

#include <cstddef>
#include <filesystem>

namespace grainfield::triaxial {

/// The folder of repeat `k` in that of the series.
std::filesystem::path repeat_folder(const std::filesystem::path& series, std::size_t k);

/// Where the state of a run that fails goes: state.h5, or state.failed.h5 where a finished run has
/// its files in the folder.
std::filesystem::path failed_state_file(const std::filesystem::path& folder);

/// Where a run keeps the packing that it makes until it has its results: packing.h5, or
/// packing.part.h5 beside the files of a finished run.
std::filesystem::path packing_in_progress(const std::filesystem::path& folder);

/// What an earlier run left of a packing in progress goes: another one begins.
void drop_packing_in_progress(const std::filesystem::path& folder);

/// From here on the folder is that of another run: without summary.json or repeats.json none is
/// finished, and what only an earlier one would have (report, failed states) goes. Call before
/// results are written, summary.json last.
void clear_earlier_run(const std::filesystem::path& folder);

/// The packing in progress and its .json take their names. FileError.
void keep_packing(const std::filesystem::path& folder);

}  // namespace grainfield::triaxial
