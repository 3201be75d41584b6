#pragma once
// The figures of the page, each a pure function of the data it shows.

#include <optional>
#include <span>
#include <string>

#include "triaxial/report/gnuplot.hpp"
#include "triaxial/report/run_folder.hpp"

namespace grainfield::triaxial::report {

/// A picture (one <svg>, or <img> elements with embedded PNG) and the sentence below it.
struct Figure {
    std::string picture;  ///< HTML
    std::string caption;  ///< HTML
};

/// Deviator stress and volumetric strain over axial strain, with the peak and the E50 secant.
Figure stress_strain_figure(const Gnuplot& gnuplot, const RunFolder& run);

/// Mohr circles at the peak with the envelope: through the origin for one run, fitted for more.
Figure mohr_figure(const Gnuplot& gnuplot, const MohrCircle& run,
                   std::span<const MohrCircle> companions);

/// Lateral stresses over their target with a band of 0.5 %.
Figure servo_figure(const Gnuplot& gnuplot, const RunFolder& run);

/// Where the work of the walls went, over time, and how well the ledger closes; energies must be
/// there.
Figure energy_figure(const Gnuplot& gnuplot, const RunFolder& run);

/// Sieve curve reached beside its target. Throws FileError where the lengths do not fit.
Figure grading_figure(const Gnuplot& gnuplot, const JsonFile& packing);

/// Stresses over the depth of the settled sample. Throws FileError where the lengths do not fit.
Figure stress_profile_figure(const Gnuplot& gnuplot, const JsonFile& packing);

/// The final sample from outside, one picture for each property that varies.
Figure sample_figure(const Gnuplot& gnuplot, const RunFolder& run);

}  // namespace grainfield::triaxial::report
