// When a test may end: what the rule of triaxial/realization/failure.hpp and the earlier one make
// of curves that go to 15 % of axial strain. bench/stopping/run makes the curves.
//
//   grainfield_stopping TESTS RUNS OUT   the plan, the folder of its runs, where tables go

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "core/files/atomic_file.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/realization/curve.hpp"
#include "triaxial/report/curve_file.hpp"
#include "triaxial/report/gnuplot.hpp"
#include "triaxial/report/json_file.hpp"

namespace {

using namespace grainfield;
using triaxial::CurvePoint;
namespace fs = std::filesystem;

/// Where a rule ends a test, and what that costs.
struct End {
    std::size_t last = 0;  ///< point of the curve
    std::string reason;
    double error = 0;  ///< of the peak, over that of the whole curve [-]
    double steps = 0;  ///< of both stages
};

struct Test {
    std::string name, half, sample;
    std::vector<CurvePoint> curve;
    triaxial::FailureRule rule;
    double confining_stress = 0, isotropic_steps = 0, shear_steps = 0;
    triaxial::CurveResults whole;
    End before, now;

    double strain(const End& end) const { return curve[end.last].axial_strain; }
    double cost() const { return now.steps / before.steps; }
};

/// The rule of earlier versions: 5 % below the highest point (or 5 % of the confining stress), or
/// 1 % of strain without a higher one, or 10 % of strain.
End end_of_earlier_rule(const Test& test) {
    double peak = 0, strain = 0;
    for (std::size_t k = 0; k < test.curve.size(); ++k) {
        const CurvePoint& p = test.curve[k];
        if (p.deviator_stress > peak) {
            peak = p.deviator_stress;
            strain = p.axial_strain;
        }
        if (peak - p.deviator_stress > 0.05 * std::max(peak, test.confining_stress))
            return {.last = k, .reason = "fell"};
        if (p.axial_strain > strain + 0.01) return {.last = k, .reason = "no higher"};
        if (p.axial_strain >= 0.1) return {.last = k, .reason = "10 %"};
    }
    return {.last = test.curve.size() - 1, .reason = "end"};
}

End end_of_rule(const Test& test) {
    for (std::size_t n = 10; n <= test.curve.size(); n += 10)  // as often as the shear stage looks
        if (const auto failure = triaxial::reached_failure({test.curve.data(), n}, test.rule))
            return {.last = n - 1, .reason = std::string(triaxial::failure_name(*failure))};
    return {.last = test.curve.size() - 1, .reason = "strain-limit"};
}

/// `from` [-]: the strain from which on a rule counts peaks.
void judge(const Test& test, End& end, double from) {
    double peak = 0;
    for (std::size_t k = 0; k <= end.last; ++k)
        if (test.curve[k].axial_strain >= from)
            peak = std::max(peak, test.curve[k].deviator_stress);
    end.error = peak / test.whole.peak_deviator_stress - 1;
    end.steps =
        test.isotropic_steps + test.shear_steps * test.strain(end) / test.curve.back().axial_strain;
}

Test read_test(const fs::path& folder) {
    Test test;
    const triaxial::report::JsonFile summary(folder / "summary.json");
    const auto curve = triaxial::report::read_curve(folder / "curve.csv");
    for (std::size_t k = 0; k < curve.size(); ++k) {
        CurvePoint p;
        p.axial_strain = curve.axial_strain[k];
        p.deviator_stress = curve.deviator_stress[k];
        p.volumetric_strain = curve.volumetric_strain[k];
        test.curve.push_back(p);
    }
    test.confining_stress = summary.number("confining_stress_Pa");
    test.isotropic_steps = summary.number("isotropic_steps");
    test.shear_steps = summary.number("shear_steps");
    test.rule = {.spheres = static_cast<std::size_t>(summary.number("particles")),
                 .transient_strain = summary.number("inertial_number")};
    test.whole = triaxial::evaluate_curve(test.curve, test.confining_stress, test.rule);
    test.before = end_of_earlier_rule(test);
    test.now = end_of_rule(test);
    judge(test, test.before, 0);
    judge(test, test.now, test.rule.transient_strain);
    return test;
}

/// The tests of the plan that have run; the others are counted.
std::vector<Test> read_tests(const fs::path& plan, const fs::path& runs, std::size_t& missing) {
    std::vector<Test> tests;
    const std::string text = core::read_whole_file(plan);
    core::LineReader lines(text);
    for (std::string_view line; lines.next(line);) {
        if (line.starts_with('#')) continue;
        const std::string name(core::next_field(line, ' ')), half(core::next_field(line, ' ')),
            sample(core::next_field(line, ' '));
        if (!fs::exists(runs / name / "summary.json")) {
            ++missing;
            continue;
        }
        tests.push_back(read_test(runs / name));
        tests.back().name = name;
        tests.back().half = half;
        tests.back().sample = sample;
    }
    return tests;
}

std::string csv(const std::vector<Test>& tests) {
    std::string text =
        "test,half,sample,spheres,confining_stress_Pa,peak_Pa,strain_at_peak,earlier_end_strain,"
        "earlier_error,end_strain,end_reason,error,steps_over_earlier\n";
    for (const Test& t : tests)
        fmt::format_to(std::back_inserter(text),
                       "{},{},{},{},{:g},{:.6g},{:.5f},{:.5f},{:.5f},{:.5f},{},{:.5f},{:.3f}\n",
                       t.name, t.half, t.sample, t.rule.spheres, t.confining_stress,
                       t.whole.peak_deviator_stress, t.whole.axial_strain_at_peak,
                       t.strain(t.before), t.before.error, t.strain(t.now), t.now.reason,
                       t.now.error, t.cost());
    return text;
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::sort(values);
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

/// A row of the summary: the tests for which `chosen` holds.
template <class Chosen>
std::string summary_row(const char* name, const std::vector<Test>& tests, Chosen chosen) {
    std::size_t n = 0, within_now = 0, within_before = 0, early = 0;
    double worst_now = 0, worst_before = 0;
    std::vector<double> costs;
    for (const Test& t : tests) {
        if (!chosen(t)) continue;
        ++n;
        within_now += std::abs(t.now.error) <= 0.005 ? 1u : 0u;
        within_before += std::abs(t.before.error) <= 0.005 ? 1u : 0u;
        worst_now = std::max(worst_now, std::abs(t.now.error));
        worst_before = std::max(worst_before, std::abs(t.before.error));
        early += t.now.reason == "strain-limit" ? 0u : 1u;
        costs.push_back(t.cost());
    }
    if (n == 0) return {};
    return fmt::format("| {} | {} | {} | {:.1f} % | {} | {:.1f} % | {} | {:.2f} |\n", name, n,
                       within_before, 100 * worst_before, within_now, 100 * worst_now, early,
                       median(costs));
}

std::string page(const std::vector<Test>& tests, std::size_t missing) {
    std::string text = fmt::format(
        "# When a test may end\n\n"
        "By `./dev bench stopping`: {} tests, each sheared to 15 % of axial strain. Where would "
        "the "
        "rule of `max_axial_strain = \"auto\"` (docs/method.md, section 6.4) have ended them, and "
        "is the largest deviator stress up to there that of the whole curve? The earlier rule "
        "ended "
        "a test 5 % below its highest point so far or 1 % of strain after it. Samples and "
        "settings: "
        "bench/stopping/packings and tests. The rule and its constants were chosen on one half and "
        "checked on the other.\n\n",
        tests.size());
    if (missing > 0)
        text += fmt::format(
            "{} further tests of the plan are not here: their packing or test ended with an error, "
            "or they were not run.\n\n",
            missing);
    text +=
        "| tests | number | earlier rule: peak within 0.5 % | worst | rule: peak within 0.5 % | "
        "worst | ended before 15 % | steps over earlier rule, median |\n|---|--:|--:|--:|--:|--:|"
        "--:|--:|\n";
    text += summary_row("chosen on", tests, [](const Test& t) { return t.half == "choose"; });
    text += summary_row("checked on", tests, [](const Test& t) { return t.half == "check"; });
    text += summary_row("all", tests, [](const Test&) { return true; });
    text += summary_row("dense, 5,168 spheres", tests,
                        [](const Test& t) { return t.sample == "dense"; });
    text += summary_row("dense, 646 spheres", tests,
                        [](const Test& t) { return t.sample == "dense-short"; });
    text +=
        "\n![Strain at the end and error of the peak](stopping.png)\n\n"
        "Every test; a name ends with what differs from 100 kPa, 0.1/s and k_n = 9e8 Pa. Errors "
        "are "
        "those of the peak.\n\n"
        "| test | half | spheres | peak (kPa) | at (%) | earlier rule: end (%) | error (%) | rule: "
        "end (%) | by | error (%) | steps over earlier rule |\n"
        "|---|---|--:|--:|--:|--:|--:|--:|---|--:|--:|\n";
    for (const Test& t : tests)
        fmt::format_to(
            std::back_inserter(text),
            "| {} | {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {} | {:.1f} | "
            "{:.2f} |\n",
            t.name, t.half, t.rule.spheres, t.whole.peak_deviator_stress / 1e3,
            100 * t.whole.axial_strain_at_peak, 100 * t.strain(t.before),
            100 * std::abs(t.before.error), 100 * t.strain(t.now), t.now.reason,
            100 * std::abs(t.now.error), t.cost());
    return text;
}

std::string picture(const std::vector<Test>& tests) {
    triaxial::report::DataBlock before, now;
    for (const Test& t : tests) {
        before.row(100 * t.strain(t.before), std::max(0.05, 100 * std::abs(t.before.error)));
        now.row(100 * t.strain(t.now), std::max(0.05, 100 * std::abs(t.now.error)));
    }
    const triaxial::report::Gnuplot gnuplot(bench::gnuplot_templates());
    return gnuplot.png("stopping", "stopping", {900, 480}, {{"before", before}, {"now", now}});
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 4) {
        std::cerr << "usage: grainfield_stopping TESTS RUNS OUT\n";
        return 2;
    }
    try {
        std::size_t missing = 0;
        const std::vector<Test> tests = read_tests(arguments[1], arguments[2], missing);
        const fs::path out = arguments[3];
        core::write_file_atomically(out / "stopping.csv", csv(tests));
        core::write_file_atomically(out / "stopping.md", page(tests, missing));
        core::write_file_atomically(out / "stopping.png", picture(tests));
        fmt::print("{} tests, {} missing; written: {}\n", tests.size(), missing,
                   (out / "stopping.md").string());
    } catch (const std::exception& error) {
        std::cerr << "grainfield_stopping: " << error.what() << '\n';
        return 1;
    }
}
