#pragma once
// The picture of run time against error.

#include <span>

#include "bench/accuracy_errors.hpp"
#include "triaxial/report/gnuplot.hpp"

namespace grainfield::bench {

/// What the picture shows of one series.
struct Panel {
    const Series* series;
    std::span<const Case> cases;
    const Case* noise;  ///< the reference ensemble against its own mean
};

inline constexpr triaxial::report::PictureSize accuracy_picture_size{1500, 1250};

/// Puts the data into gnuplot's folder; returns the script. Columns: peak and E50; rows: series.
std::string accuracy_script(const triaxial::report::Gnuplot& gnuplot,
                            std::span<const Panel> panels);

}  // namespace grainfield::bench
