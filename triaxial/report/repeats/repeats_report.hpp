#pragma once
// The page of a series of repeats: what a single run of the sample scatters by.

#include <filesystem>

namespace grainfield::triaxial {

/// Reads the folder of a finished series and writes DIR/report.html, one page with a table and a
/// figure of all curves. Returns the page's path. Throws FileError as write_report(); an older page
/// stays whole unless the new one is complete.
std::filesystem::path write_repeats_report(const std::filesystem::path& dir);

}  // namespace grainfield::triaxial
