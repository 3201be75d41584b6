#pragma once
// The picture of fields: time a field against its covariance error.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "randomfield/grid.hpp"

namespace grainfield::bench {

/// One generator on one grid at one correlation length.
struct FieldPoint {
    std::string method;
    randomfield::CellCount cells{};           ///< [-]
    double theta_y = 0.0;                     ///< a tenth of theta_x and theta_z [m]
    std::int64_t stage0 = 0;                  ///< largest stage 0 [cells]
    std::optional<double> set_up;             ///< none: the generator refuses [s]
    double normals = 0.0;                     ///< drawing the normals of a field [s]
    std::optional<double> field_in_parallel;  ///< wall time on all cores, of large ones [s]
    double field = 0.0;                       ///< a field, its normals included [s]
    std::optional<double> error;  ///< of covariance, in units of gamma; none: not computed [-]
};

/// A panel for each grid whose errors are known: a PNG file's bytes.
std::string fields_picture(const std::vector<FieldPoint>& points);

}  // namespace grainfield::bench
