#pragma once
// How loose and how dense the spheres of a block can be, and where a porosity lies between.

#include <string>

namespace grainfield::packing {

/// Volume of the pores over that of the grains of a porosity [-].
double void_ratio(double porosity);

/// Porosities of the same spheres in the same block, found by the same procedure (docs/method.md,
/// section 4.3): what a soil's e_min and e_max are to it.
struct DensityRange {
    double densest = 0;  ///< shaken without friction [-]
    double loosest = 0;  ///< fallen and levelled, with full friction [-]

    /// False where both are the same but for chance, as of a few grains or without friction: there
    /// is no relative density then.
    bool known() const { return loosest - densest > 2e-3; }
    /// D_r = (e_max - e)/(e_max - e_min), e the void ratio of the porosity; not a number where the
    /// range is not known() [-].
    double relative_density(double porosity) const;
    /// Porosity of a relative density [-].
    double porosity(double relative_density) const;
    /// "porosity 0.4000 = relative density 85 %; this block can have 0.386 to 0.474"
    std::string text(double porosity) const;
};

}  // namespace grainfield::packing
