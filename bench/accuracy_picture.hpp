#pragma once
// The picture of run time against error.

#include <span>
#include <string>

#include "bench/accuracy_errors.hpp"
#include "triaxial/report/gnuplot.hpp"

namespace grainfield::bench {

/// What the picture shows of one series.
struct Panel {
    const Series* series;
    std::span<const Case> cases;
    const Case* noise;  ///< the reference ensemble against its own mean
};

/// A PNG file's bytes. Columns: peak and E50; rows: series.
std::string accuracy_picture(std::span<const Panel> panels);

}  // namespace grainfield::bench
