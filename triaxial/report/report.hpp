#pragma once
// The report of one triaxial run: a self-contained page with the figures of Fig. 5 of Tran et al.
// and what is needed to trust them.

#include <filesystem>
#include <span>

namespace grainfield::triaxial {

/// Reads the folder of a triaxial run and writes DIR/report.html: one page that needs no network
/// and no other file. The figures are drawn by gnuplot (Debian package gnuplot-nox).
/// `companions` are folders of runs at other confining stresses; their Mohr circles join the
/// figure and a straight-line envelope is fitted through all.
/// Returns the page's path. Throws FileError naming the file that is missing, corrupt or cannot be
/// written, or saying that gnuplot is not there; InputError where the companions' confining
/// stresses do not differ. An older report.html stays whole unless the new one is complete.
std::filesystem::path write_report(const std::filesystem::path& dir,
                                   std::span<const std::filesystem::path> companions = {});

}  // namespace grainfield::triaxial
