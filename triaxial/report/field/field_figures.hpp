#pragma once
// The figures of a field's verification, each a pure function of what it shows.

#include <span>
#include <string>

#include "randomfield/verification/verification.hpp"
#include "triaxial/report/figures.hpp"

namespace grainfield::triaxial::report {

/// "friction angle", "normal stiffness", or "G" where no property is random.
std::string property_name(const std::optional<randomfield::Property>& property);

/// What a property is divided by in figures and tables, and the unit that gives: rad, MPa.
struct DisplayUnit {
    double size = 1;   ///< [rad or Pa]
    std::string name;  ///< "rad"
    Markup label;      ///< quantity and unit
};
DisplayUnit display_unit(const std::optional<randomfield::Property>& property);

/// Correlation of cells along x, y and z: estimated, exact, and the band.
Figure correlation_figure(const Gnuplot& gnuplot, const std::string& id,
                          const randomfield::FieldCheck& check, const Vec3& cell_size);

/// Correlation of two points tau_x = tau_y = tau_z apart (Fig. 2 of Tran et al.), for the
/// correlation lengths of the config and multiples of them.
Figure point_correlation_figure(const Gnuplot& gnuplot,
                                const randomfield::CorrelationModel& correlation, double longest);

/// Values of cells in bins against the predicted distribution.
Figure cell_histogram_figure(const Gnuplot& gnuplot, const std::string& id,
                             randomfield::Property property,
                             const randomfield::HistogramCheck& check,
                             const randomfield::RowMarginals& marginals);

/// Variance of every cell over gamma, with the bands of one cell and of all together.
Figure variance_figure(const Gnuplot& gnuplot, const std::string& id,
                       const randomfield::VarianceMap& map);

/// Slices x-y of a column of cells at up to six z, in one picture.
Figure slices_figure(const Gnuplot& gnuplot, const std::string& id,
                     const randomfield::GridSpec& grid, std::span<const double> values,
                     Markup label, const std::string& caption);

/// The blocks from outside, coloured by their property (Fig. 4 of Tran et al.).
Figure blocks_figure(const Gnuplot& gnuplot, const std::string& id,
                     const randomfield::BlockField& field, randomfield::Property property);

}  // namespace grainfield::triaxial::report
