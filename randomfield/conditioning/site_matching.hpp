#pragma once
// Measurements with errors as direct, Gaussian measurements of G, by expectation propagation.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "randomfield/conditioning/noisy_value.hpp"

namespace grainfield::randomfield {

/// Largest number of cells that are matched together: some seconds a sweep [cells].
inline constexpr std::size_t most_matched_cells = 2048;

/// A cell with data: an exact score, or a measurement with an error.
struct CellKnowledge {
    std::optional<double> exact;  ///< score [-]
    NoisyValue measured;          ///< where it is not exact
};

/// The sites of all measurements with errors (others are left 0), so that for each of them the
/// joint normal distribution of G, given all exact scores and sites, has the mean and variance that
/// the measurement itself gives in place of its site: expectation propagation (Minka 2001), cell by
/// cell until nothing changes. One measurement alone has exactly the right two moments; where all
/// marginals are normal the joint distribution is exact.
///
/// Above most_matched_cells every measurement is matched alone, given the prior only.
/// covariance: prior of G of the cells with data, size x size. Cells whose G the others leave no
/// room for keep a site made from the prior alone. Every moments_given() of a measurement under its
/// own prior must exist. The same bits on every machine: no sum is split.
std::vector<GaussianSite> match_sites(std::span<const CellKnowledge> cells,
                                      std::vector<double> covariance);

}  // namespace grainfield::randomfield
