#include "packing/density_range.hpp"

#include <fmt/format.h>

#include <limits>

namespace grainfield::packing {

double void_ratio(double porosity) {
    return porosity / (1 - porosity);
}

double DensityRange::relative_density(double porosity) const {
    if (!known()) return std::numeric_limits<double>::quiet_NaN();
    return (void_ratio(loosest) - void_ratio(porosity)) /
           (void_ratio(loosest) - void_ratio(densest));
}

double DensityRange::porosity(double relative_density) const {
    const double e =
        void_ratio(loosest) - relative_density * (void_ratio(loosest) - void_ratio(densest));
    return e / (1 + e);
}

std::string DensityRange::text(double porosity) const {
    const std::string range = fmt::format("this block can have {:.3f} to {:.3f}", densest, loosest);
    if (!known()) return fmt::format("porosity {:.4f}; {}", porosity, range);
    return fmt::format("porosity {:.4f} = relative density {:.0f} %; {}", porosity,
                       100 * relative_density(porosity), range);
}

}  // namespace grainfield::packing
