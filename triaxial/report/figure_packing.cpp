// The two figures of the packing the run started from: its sieve curve and its stress profile.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "triaxial/report/figures.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

/// Arrays of packing.json under one key, all of one length and not empty.
std::vector<std::vector<double>> columns(const JsonFile& packing, const std::string& group,
                                         std::initializer_list<std::string_view> names) {
    std::vector<std::vector<double>> all;
    for (const auto name : names) {
        all.push_back(packing.numbers(fmt::format("{}.{}", group, name)));
        if (all.back().size() < 2 || all.back().size() != all.front().size())
            throw FileError(fmt::format(
                "{}: key '{}.{}' has {} values, must have as many as the others of '{}', two at "
                "least ({})",
                packing.path().string(), group, name, all.back().size(), group,
                all.front().size()));
    }
    return all;
}

DataBlock table(const std::vector<std::vector<double>>& all, std::initializer_list<double> scale) {
    DataBlock rows;
    for (std::size_t i = 0; i < all.front().size(); ++i) {
        const double* factor = scale.begin();
        for (const auto& column : all) rows.add(*factor++ * column[i]);
        rows.end_row();
    }
    return rows;
}

/// The target is linear in the diameter between sieves: curved on a logarithmic axis.
DataBlock target_line(const std::vector<double>& diameter, const std::vector<double>& passing) {
    DataBlock rows;
    for (std::size_t i = 1; i < diameter.size(); ++i) {
        for (int step = 0; step <= 20; ++step) {
            const double t = step / 20.0;
            rows.row(1e3 * (diameter[i - 1] + t * (diameter[i] - diameter[i - 1])),
                     passing[i - 1] + t * (passing[i] - passing[i - 1]));
        }
    }
    return rows;
}

}  // namespace

Figure grading_figure(const Gnuplot& gnuplot, const JsonFile& packing) {
    const auto sieves =
        columns(packing, "grading",
                {"sieve_diameter_m", "target_passing_percent", "achieved_passing_percent"});
    DataBlock achieved;
    if (packing.has("grading.achieved_curve"))
        achieved =
            table(columns(packing, "grading.achieved_curve", {"diameter_m", "passing_percent"}),
                  {1e3, 1});
    double worst = 0;
    for (std::size_t i = 0; i < sieves[0].size(); ++i)
        worst = std::max(worst, std::abs(sieves[1][i] - sieves[2][i]));
    return {
        gnuplot.svg("figure_grading", "grading", "Grading reached beside the target", {520, 400},
                    {{"sieves", table(sieves, {1e3, 1, 1})},
                     {"target", target_line(sieves[0], sieves[1])},
                     {"achieved", achieved},
                     {"low", 0.9e3 * sieves[0].front()},
                     {"high", 1.1e3 * sieves[0].back()}}),
        fmt::format("Grading of the sample beside its target (linear in the diameter between "
                    "sieves). The largest difference at a sieve is {} percentage points.",
                    significant(worst, 2))};
}

Figure stress_profile_figure(const Gnuplot& gnuplot, const JsonFile& packing) {
    const auto profile = columns(packing, "stress_profile",
                                 {"depth_m", "vertical_Pa", "horizontal_x_Pa", "horizontal_z_Pa",
                                  "theory_vertical_Pa", "theory_horizontal_Pa"});
    std::string caption = "Stresses in the sample settled under its own weight, before the test.";
    const auto slope = packing.optional_number("vertical_stress_slope_ratio");
    const auto r2 = packing.optional_number("vertical_stress_r2");
    const auto k0 = packing.optional_number("K0");
    if (slope && r2)
        caption += fmt::format(" Fitted vertical gradient over γ: {} (<i>R</i>² = {}).",
                               significant(*slope), significant(*r2, 5));
    if (k0) caption += fmt::format(" <i>K</i><sub>0</sub> = {}.", significant(*k0, 3));
    return {gnuplot.svg("figure_stress_profile", "stress_profile",
                        "Vertical and horizontal stress over depth", {520, 400},
                        {{"profile", table(profile, {1, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3})},
                         {"deepest", 1.03 * std::ranges::max(profile[0])}}),
            caption};
}

}  // namespace grainfield::triaxial::report
