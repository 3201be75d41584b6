#pragma once
// What pictures of a box from outside share: the range of the picture, the box's edges with its
// sizes, and the scale of the colours.

#include <string>

#include "triaxial/report/colouring.hpp"
#include "triaxial/report/gnuplot.hpp"
#include "triaxial/report/sample_view.hpp"

namespace grainfield::triaxial::report {

struct BoxFrame {
    PictureSize size;  ///< of the picture with its scale
    double pixel = 0;  ///< width of a pixel [m]
    std::string
        script;         ///< gnuplot: sets everything up; pictures plot camera coordinates in metres
    std::string scale;  ///< a clause for the plot command that makes the scale appear; may be empty
};

BoxFrame box_frame(const core::Box& box, const Camera& camera, const Colouring& colouring);

}  // namespace grainfield::triaxial::report
