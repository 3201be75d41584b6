#pragma once
// What pictures of a box from outside share: the range of the picture, the box's edges with its
// sizes, and the scale of the colours.

#include "triaxial/report/colouring.hpp"
#include "triaxial/report/gnuplot.hpp"
#include "triaxial/report/sample_view.hpp"

namespace grainfield::triaxial::report {

struct BoxFrame {
    PictureSize size;            ///< of the picture with its scale
    double pixel = 0;            ///< width of a pixel [m]
    GnuplotVariables variables;  ///< for box_frame.gnuplot; plots are in camera coordinates [m]
};

BoxFrame box_frame(const core::Box& box, const Camera& camera, const Colouring& colouring);

}  // namespace grainfield::triaxial::report
