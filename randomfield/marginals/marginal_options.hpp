#pragma once
// What the distribution of one property of the soil is asked to be.

#include <optional>

namespace grainfield::randomfield {

/// The properties that a field may make random.
enum class Property { friction_angle, normal_stiffness };

enum class MarginalKind { bounded, lognormal, normal, truncated_normal, beta, weibull };

/// Distribution of a property at a point, at mid-height of the sample. The property of a point is
/// the quantile of its standard normal G; that of a cell is the same function of the cell's average
/// of G, whose variance is gamma < 1, as in Tran et al.
struct MarginalOptions {
    MarginalKind kind = MarginalKind::lognormal;
    std::optional<double> minimum;  ///< of bounded, truncated normal, beta [rad or Pa]
    std::optional<double> maximum;  ///< of bounded, truncated normal, beta [rad or Pa]
    double s = 2.0;                 ///< of bounded: variability factor, Eq. (7) of Tran et al. [-]
    double mean = 0.0;  ///< of all but bounded; truncated normal: before the cut [rad or Pa]
    double cov = 0.0;   ///< coefficient of variation, of and as the mean [-]
    double mean_gradient = 0.0;  ///< growth of the mean with height y (bounded: of both bounds);
                                 ///< the coefficient of variation stays [rad/m or Pa/m]
    bool preserve_mean = false;  ///< scale cells so that their mean is a point's [-]
};

}  // namespace grainfield::randomfield
