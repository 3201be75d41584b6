#pragma once
// curve.csv of a triaxial run: the shear stage, one row a record.

#include <filesystem>
#include <optional>
#include <vector>

namespace grainfield::triaxial::report {

/// Columns of curve.csv, all of one length. Compression and contraction are positive.
struct Curve {
    std::vector<double> axial_strain;            ///< [-]
    std::vector<double> deviator_stress;         ///< q = sigma_1 - sigma_3 [Pa]
    std::vector<double> axial_stress;            ///< sigma_1 [Pa]
    std::vector<double> lateral_stress_x;        ///< [Pa]
    std::vector<double> lateral_stress_z;        ///< [Pa]
    std::vector<double> volumetric_strain;       ///< [-]
    std::vector<double> unbalanced_force_ratio;  ///< [-]
    std::vector<double> time;                    ///< [s]
    std::vector<double> contacts;                ///< [-]

    std::size_t size() const { return axial_strain.size(); }
};

/// How far the lateral stresses were from the confining stress, over both pairs of walls and all
/// records.
struct ServoError {
    double rms = 0;  ///< over the confining stress [-]
    /// The same, largest at any record after 0.1 % of strain; none where there is no such record
    /// [-].
    std::optional<double> max;
};

/// Reads curve.csv. Throws FileError as read_number_table().
Curve read_curve(const std::filesystem::path& path);

ServoError servo_error(const Curve& curve, double confining_stress);

}  // namespace grainfield::triaxial::report
