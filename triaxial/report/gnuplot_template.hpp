#pragma once
// The .gnuplot files beside the figures' code, which are compiled into the library that draws them
// (embed_gnuplot.cmake).

#include <span>
#include <string_view>

namespace grainfield {

namespace triaxial::report {

struct GnuplotTemplate {
    std::string_view name;  ///< of the file, without its suffix
    std::string_view text;  ///< all of it
};

/// Those below triaxial/report/, in any order.
std::span<const GnuplotTemplate> gnuplot_templates();

}  // namespace triaxial::report

namespace bench {

/// Those of bench/.
std::span<const triaxial::report::GnuplotTemplate> gnuplot_templates();

}  // namespace bench

}  // namespace grainfield
