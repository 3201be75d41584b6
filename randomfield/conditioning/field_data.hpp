#pragma once
// Measured values of the soil, for example of a cone penetration test, that a field is to honour.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "randomfield/covariance/covariance.hpp"
#include "randomfield/grid.hpp"
#include "randomfield/marginals/marginal_options.hpp"

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
    double value = 0.0;     ///< as measured (several: weighed by their precision) [rad or Pa]
    std::int32_t line = 0;  ///< of the first measurement behind it, for messages [-]
};

/// Measurements as knowledge of G, by the marginal of their cell's row. Those of one cell are
/// combined by their precision; an exact value outweighs all others. Where there is an error, value
/// = T(G) + error e is not normal in G; the datum that stands for it is matched to the moments of
/// all cells with data together (site_matching.hpp), exactly for a single one. A value with an
/// error may lie outside the marginal's range. covariance: C by lag in cells; correlation: rho
/// between the two properties; marginals(property): nullptr where that property is not random.
/// InputError with file and line: a property that is not random, an exact value outside the
/// marginal's range, a value further outside than its error explains, an error too small to be told
/// from 0, two different exact values in one cell, too many cells; a value further than
/// furthest [-] from the distribution of its cell, and its errors with it: likely one in
/// other units.
std::vector<CellDatum> cell_data(const std::filesystem::path& path,
                                 const std::vector<Measurement>& measurements, const GridSpec& grid,
                                 const LocalAverageCovariance& covariance, double correlation,
                                 const std::function<const RowMarginals*(Property)>& marginals,
                                 double furthest = std::numeric_limits<double>::infinity());

}  // namespace grainfield::randomfield
