#pragma once
// From a packing and a random field to the sample of a test.

#include <filesystem>
#include <optional>
#include <string>

#include "core/files/sphere_file.hpp"
#include "randomfield/block_field.hpp"
#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::triaxial {

/// Reads a packing for a test. Its box is box_of_packing(). Spheres that bring a mass keep it.
/// Other properties are those of [particle]; columns that a file brings override them, but for
/// packings and starts of grainfield. Throws InputError (bad spheres, overlaps, a column of a
/// property that field.variable makes random), FileError.
core::SphereFile read_packing(const std::filesystem::path& path, const Config& config);
/// The same of what has been read from `path` already.
core::SphereFile packing_for_test(core::SphereFile file, const std::filesystem::path& path,
                                  const Config& config);

/// A sample of what was read. A file that was written as the start of tests brings the shear forces
/// of its contacts. Throws FileError where these are damaged.
Sample sample_of(core::SphereFile file, const std::filesystem::path& path);

/// Reads the data that the field is conditioned on, where there are any, before anything else takes
/// time over them. Throws InputError, FileError as randomfield::FieldGenerator.
void check_field_data(const Config& config);

/// What the random field did to the sample, for summary.json.
struct FieldRecord {
    randomfield::Variable variable = randomfield::Variable::none;
    std::int64_t realization = 0;
    double gamma = 0;                        ///< variance of a cell's G [-]
    std::optional<double> covariance_error;  ///< field_covariance_error(), where looked for [-]
    double mean_ratio_expected = 1;          ///< E[k]/mu (stiffness) [-]
    double mean_ratio_cells = 1;             ///< of this realization's cells [-]
    randomfield::BlockField field;           ///< empty without a random variable
};

/// Largest covariance error of the config's random field, in units of gamma; none without a random
/// variable or on grids too large for it. Up to seconds: for the one run whose summary states it,
/// not for those of a campaign. Throws InputError as randomfield::make_generator.
std::optional<double> field_covariance_error(const Config& config);

/// Draws realization k and maps it onto the spheres, block by block; spheres without a block take
/// that of the cell they lie in. Does nothing with field.variable = "none". Throws InputError if a
/// block lies outside the field's grid, or where that grid does not fit the box.
FieldRecord map_field(const Config& config, std::int64_t realization, Sample& sample);

}  // namespace grainfield::triaxial
