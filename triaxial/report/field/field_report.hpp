#pragma once
// The page and the tables of a field's verification.

#include <filesystem>

#include "randomfield/verification/verification.hpp"

namespace grainfield::triaxial {

/// Writes into a folder, which is made where it does not exist: verification.html, one
/// self-contained page with verdicts and pictures, and the numbers behind it in correlation.csv,
/// histogram.csv and variance.csv. Returns the page. FileError where that fails or gnuplot does.
std::filesystem::path write_field_report(const std::filesystem::path& folder,
                                         const randomfield::FieldGenerator& generator,
                                         const randomfield::Verification& verification);

}  // namespace grainfield::triaxial
