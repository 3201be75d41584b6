#pragma once
// The figures of a campaign's report, each a pure function of what it shows. `id` names a figure
// within the page.

#include <span>
#include <string>
#include <vector>

#include "triaxial/report/campaign/axis_name.hpp"
#include "triaxial/report/campaign/case_statistics.hpp"
#include "triaxial/report/figures.hpp"
#include "triaxial/statistics/distributions.hpp"

namespace grainfield::triaxial::report {

/// Running mean and deviation over the number of realizations with their 95 % intervals (the
/// paper's Fig. 6). Two values or more.
Figure convergence_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                          std::span<const double> values, std::optional<double> deterministic);

/// Histogram with the fitted distributions (Figs. 7 and 11). Values must differ.
Figure histogram_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                        std::span<const double> values, std::span<const statistics::Fit> fits);

/// P-P plot of a fit with its bands (Figs. 8 and 12).
Figure probability_figure(const Gnuplot& gnuplot, const std::string& id, const Quantity& quantity,
                          std::span<const double> values, const statistics::Fit& fit);

/// One line of a trend: a point a case.
struct Trend {
    struct Point {
        double x;                ///< of the key that varies, in the figure's unit
        std::size_t case_index;  ///< two rows or more
    };
    std::string name;  ///< what the other keys are; may be empty
    std::vector<Point> points;
};

/// Mean and deviation against a key that varies, with 95 % intervals and the deterministic values
/// (Figs. 9, 10, 13 and 14); `q` is the quantity's number.
Figure trend_figure(const Gnuplot& gnuplot, const std::string& id, std::size_t q,
                    const AxisName& axis, std::span<const Trend> trends,
                    const CampaignStatistics& all);

/// The trends over a config key: cases that agree in all other keys make a line. Only keys with a
/// number (of a correlation length: that in y) have any.
std::vector<Trend> trends_over(const CampaignData& data, const std::string& key);

}  // namespace grainfield::triaxial::report
