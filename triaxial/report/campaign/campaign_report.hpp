#pragma once
// The report of a campaign: one self-contained page with the figures of Tran et al. and what they
// lack.

#include <filesystem>

namespace grainfield::triaxial {

/// Reads the folder of a campaign, finished or not, and writes DIR/report.html and
/// DIR/statistics.csv (a row a case and quantity). Returns the page's path. Throws FileError; an
/// older report stays whole unless the new one is complete.
std::filesystem::path write_campaign_report(const std::filesystem::path& dir);

}  // namespace grainfield::triaxial
