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

std::string table(const std::vector<std::vector<double>>& all,
                  std::initializer_list<double> scale) {
    std::string rows;
    for (std::size_t i = 0; i < all.front().size(); ++i) {
        const double* factor = scale.begin();
        for (const auto& column : all) rows += fmt::format("{} ", *factor++ * column[i]);
        rows += '\n';
    }
    return rows;
}

/// The target is linear in the diameter between sieves: curved on a logarithmic axis.
std::string target_line(const std::vector<double>& diameter, const std::vector<double>& passing) {
    std::string rows;
    for (std::size_t i = 1; i < diameter.size(); ++i) {
        for (int step = 0; step <= 20; ++step) {
            const double t = step / 20.0;
            rows += fmt::format("{} {}\n",
                                1e3 * (diameter[i - 1] + t * (diameter[i] - diameter[i - 1])),
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
    gnuplot.data("sieves.dat", table(sieves, {1e3, 1, 1}));
    gnuplot.data("target.dat", target_line(sieves[0], sieves[1]));
    std::string achieved;
    if (packing.has("grading.achieved_curve")) {
        const auto curve =
            columns(packing, "grading.achieved_curve", {"diameter_m", "passing_percent"});
        gnuplot.data("achieved.dat", table(curve, {1e3, 1}));
        achieved = fmt::format("'achieved.dat' with steps lw 1.8 lc rgb '{}' title 'this sample', ",
                               colour::main);
    }
    double worst = 0;
    std::string ticks;
    for (std::size_t i = 0; i < sieves[0].size(); ++i) {
        worst = std::max(worst, std::abs(sieves[1][i] - sieves[2][i]));
        ticks += fmt::format("{0}'{1:.4g}' {1:.6g}", i == 0 ? "" : ", ", 1e3 * sieves[0][i]);
    }
    const std::string script = fmt::format(
        R"(set lmargin at screen 0.135
set rmargin at screen 0.975
set tmargin at screen 0.97
set bmargin at screen 0.145
set logscale x
set xrange [{low}:{high}]
set yrange [0:104]
set ytics 20
set xtics ({ticks})
set xlabel 'Diameter (mm)' offset 0,0.3
set ylabel 'Passing (% by mass)' offset 0.5,0
set key bottom right
plot 'target.dat' with lines lw 1.6 dt (6,4) lc rgb '{contrast}' title 'target', \
     {achieved}'sieves.dat' using 1:3 with points pt 7 ps 0.6 lc rgb '{main}' title 'this sample at the sieves'
)",
        fmt::arg("low", 0.9e3 * sieves[0].front()), fmt::arg("high", 1.1e3 * sieves[0].back()),
        fmt::arg("ticks", ticks), fmt::arg("achieved", achieved), fmt::arg("main", colour::main),
        fmt::arg("contrast", colour::contrast));
    return {gnuplot.svg("grading", "Grading reached beside the target", {520, 400}, script),
            fmt::format("Grading of the sample beside its target (linear in the diameter between "
                        "sieves). The largest difference at a sieve is {} percentage points.",
                        significant(worst, 2))};
}

Figure stress_profile_figure(const Gnuplot& gnuplot, const JsonFile& packing) {
    const auto profile = columns(packing, "stress_profile",
                                 {"depth_m", "vertical_Pa", "horizontal_x_Pa", "horizontal_z_Pa",
                                  "theory_vertical_Pa", "theory_horizontal_Pa"});
    gnuplot.data("profile.dat", table(profile, {1, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3}));
    const std::string script = fmt::format(
        R"(set lmargin at screen 0.135
set rmargin at screen 0.975
set tmargin at screen 0.97
set bmargin at screen 0.145
set xrange [0:*]
set yrange [{depth}:0]
set xlabel 'Stress (kPa)' offset 0,0.3
set ylabel 'Depth (m)' offset 0.5,0
set key top right
plot 'profile.dat' using 5:1 with lines lw 1.6 lc rgb '{main}' title 'γ{{/:Italic z}}', \
     'profile.dat' using 2:1 with points pt 7 ps 0.6 lc rgb '{main}' title 'vertical', \
     'profile.dat' using 6:1 with lines lw 1.6 dt (6,4) lc rgb '{contrast}' title '{{/:Italic K}}_0γ{{/:Italic z}}', \
     'profile.dat' using 3:1 with points pt 4 ps 0.6 lc rgb '{contrast}' title 'horizontal, x', \
     'profile.dat' using 4:1 with points pt 6 ps 0.7 lc rgb '{contrast}' title 'horizontal, z'
)",
        fmt::arg("depth", 1.03 * std::ranges::max(profile[0])), fmt::arg("main", colour::main),
        fmt::arg("contrast", colour::contrast));
    std::string caption = "Stresses in the sample settled under its own weight, before the test.";
    const auto slope = packing.optional_number("vertical_stress_slope_ratio");
    const auto r2 = packing.optional_number("vertical_stress_r2");
    const auto k0 = packing.optional_number("K0");
    if (slope && r2)
        caption += fmt::format(" Fitted vertical gradient over γ: {} (<i>R</i>² = {}).",
                               significant(*slope), significant(*r2, 5));
    if (k0) caption += fmt::format(" <i>K</i><sub>0</sub> = {}.", significant(*k0, 3));
    return {gnuplot.svg("stress_profile", "Vertical and horizontal stress over depth", {520, 400},
                        script),
            caption};
}

}  // namespace grainfield::triaxial::report
