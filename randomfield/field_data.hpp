#pragma once
// Measured values of the soil, for example of a cone penetration test, that a field is to honour.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "randomfield/grid.hpp"
#include "randomfield/marginal_options.hpp"

namespace grainfield::randomfield {

class RowMarginals;

/// One line of the file.
struct Measurement {
    Property property = Property::friction_angle;
    Vec3 position{0, 0, 0};  ///< from the lower corner of the sample [m]
    double value = 0.0;      ///< average over the block that holds the position [rad or Pa]
    double error = 0.0;      ///< its standard deviation, 0: exact [rad or Pa]
    std::int32_t line = 0;   ///< in the file, for messages [-]
};

/// Reads a CSV of measurements. Header x,y,z,property,value,error, or x,y,z,value,error where a
/// single property is random (`only`); property is friction_angle or normal_stiffness; blank lines
/// and lines that start with # do not count. InputError with file and line: another header, no
/// values, numbers that are none, a property that does not exist, positions outside the grid, a
/// value that the property cannot have, a negative error. FileError where it cannot be read.
std::vector<Measurement> read_measurements(const std::filesystem::path& path, const GridSpec& grid,
                                           std::optional<Property> only);

/// What is known of the Gaussian field of a property in one cell.
struct CellDatum {
    Property property = Property::friction_angle;
    std::size_t cell = 0;   ///< GridSpec::index() [-]
    double score = 0.0;     ///< the measured G [-]
    double variance = 0.0;  ///< of its error, 0: exact [-]
};

/// Turns measurements into scores by the marginal of their cell's row, the error by the marginal's
/// slope there, and combines those of one cell by their precision (an exact value outweighs all
/// others). marginals(property): nullptr where that property is not random. InputError with file
/// and line: a property that is not random, a value outside the marginal's range, two different
/// exact values in one cell.
std::vector<CellDatum> cell_data(const std::filesystem::path& path,
                                 const std::vector<Measurement>& measurements, const GridSpec& grid,
                                 const std::function<const RowMarginals*(Property)>& marginals);

}  // namespace grainfield::randomfield
