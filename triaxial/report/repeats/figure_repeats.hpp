#pragma once
// The figure of a series of repeats.

#include "triaxial/report/figures.hpp"
#include "triaxial/report/repeats/repeats_data.hpp"

namespace grainfield::triaxial::report {

/// Deviator stress over axial strain of all repeats, with the largest of each.
Figure repeats_figure(const Gnuplot& gnuplot, const RepeatsData& data);

}  // namespace grainfield::triaxial::report
