// Strain rate and damping: what the largest deviator stress and E50 tend to as a test becomes
// endlessly slow, how far off a test at some rate is, and what it costs. bench/rate/run makes the
// tests.
//
//   grainfield_rate SAMPLES RUNS OUT   the samples, the folder of the tests, where tables go

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <iostream>

#include "bench/rate_limit.hpp"
#include "bench/rate_runs.hpp"
#include "core/files/atomic_file.hpp"
#include "triaxial/realization/quality.hpp"
#include "triaxial/report/gnuplot.hpp"

namespace {

using namespace grainfield;
using bench::RateCell;
using bench::RateLimit;
using bench::RateRun;
using bench::RateSample;
namespace fs = std::filesystem;

/// A sample and what its results tend to.
struct Study {
    const RateSample* sample;
    RateLimit peak, E50;
};

RateLimit limit_of(const RateSample& sample, double RateRun::*value) {
    std::vector<bench::RatePoint> points;
    double sum = 0;
    for (const RateCell& cell : sample.cells)
        for (std::size_t d = 0; d < sample.dampings.size(); ++d)
            if (sample.dampings[d] == cell.damping) {
                points.push_back({static_cast<int>(d), cell.rate, cell.mean(value),
                                  static_cast<int>(cell.runs.size())});
                sum += cell.mean(value);
            }
    const double middle = sum / static_cast<double>(points.size());
    return bench::rate_limit(points, sample.dampings.size(), sample.scatter(value) * middle);
}

/// Of the tests at a damping: the mean number of steps before shear, and of shear at 1/s.
struct Steps {
    double isotropic = 0, shear = 0;
    double at(double rate) const { return isotropic + shear / rate; }
};

Steps steps_of(const RateSample& sample, double damping) {
    Steps steps;
    double cells = 0;
    for (const RateCell& cell : sample.cells) {
        if (cell.damping != damping) continue;
        ++cells;
        steps.isotropic += cell.mean(&RateRun::isotropic_steps);
        steps.shear += cell.mean(&RateRun::shear_steps) * cell.rate;
    }
    return {steps.isotropic / cells, steps.shear / cells};
}

/// "0.05/s | 1.9", or that every rate of the study will do.
std::string price(const Study& study, std::size_t d, double share) {
    const RateSample& sample = *study.sample;
    const double rate = study.peak.rate_within(d, share);
    double slowest = bench::study_rates.front();
    for (const RateCell& cell : sample.cells)
        if (cell.damping == sample.dampings[d]) slowest = std::min(slowest, cell.rate);
    if (rate < slowest) return fmt::format("below {}/s | –", slowest);
    const Steps steps = steps_of(sample, sample.dampings[d]);
    if (rate > bench::study_rates.front())
        return fmt::format("above {}/s | below {:.2f}", bench::study_rates.front(),
                           steps.at(bench::study_rates.front()) / steps.at(0.1));
    return fmt::format("{:.2g}/s | {:.2g}", rate, steps.at(rate) / steps.at(0.1));
}

/// "227.7 | 226.1 to 229.3"; a dash where the tests do not tell.
std::string limit_text(const RateLimit& limit, double scale) {
    if (limit.high - limit.low > 0.5 * limit.value) return "– | –";
    return fmt::format("{:.1f} | {:.1f} to {:.1f}", scale * limit.value, scale * limit.low,
                       scale * limit.high);
}

std::string summary_table(const std::vector<Study>& studies) {
    std::string text =
        "| sample | spheres | inertial number at 0.1/s | limit of the largest q (kPa) | 95 % | one "
        "run scatters by | limit of E50 (MPa) | 95 % |\n|---|--:|--:|--:|---|--:|--:|---|\n";
    for (const Study& s : studies) {
        const RateSample& sample = *s.sample;
        const RateCell& first = sample.cells.front();
        fmt::format_to(std::back_inserter(text), "| {} | {:.0f} | {:.2g} | {} | {:.1f} % | {} |\n",
                       sample.name, first.mean(&RateRun::spheres),
                       first.mean(&RateRun::inertial_number) * 0.1 / first.rate,
                       limit_text(s.peak, 1e-3), 100 * sample.scatter(&RateRun::peak),
                       limit_text(s.E50, 1e-6));
    }
    return text;
}

/// How far off the tests are that count as quasi-static, and the others.
std::string quasi_static_table(const std::vector<Study>& studies) {
    std::string text =
        "| sample | quasi-static | farthest off | not so | of these within 5 % |\n"
        "|---|--:|--:|--:|--:|\n";
    for (const Study& s : studies) {
        std::size_t inside = 0, outside = 0, near = 0;
        double worst = 0;
        for (const RateCell& cell : s.sample->cells) {
            const double off = cell.mean(&RateRun::peak) / s.peak.value - 1;
            if (cell.mean(&RateRun::inertial_number) <= triaxial::quasi_static_inertial_number &&
                cell.mean(&RateRun::damping_share) <= triaxial::quasi_static_damping_share) {
                ++inside;
                if (std::abs(off) > std::abs(worst)) worst = off;
            } else {
                ++outside;
                near += std::abs(off) <= 0.05 ? 1u : 0u;
            }
        }
        text +=
            fmt::format("| {} | {} | {} | {} | {} |\n", s.sample->name, inside,
                        inside == 0 ? "–" : fmt::format("{:+.1f} %", 100 * worst), outside, near);
    }
    return text;
}

std::string price_table(const std::vector<Study>& studies) {
    std::string text =
        "| sample | damping | off at 0.1/s | within 5 % from | steps over those at 0.1/s | within "
        "2 % from | steps |\n|---|--:|--:|--:|--:|--:|--:|\n";
    for (const Study& s : studies)
        for (std::size_t d = 0; d < s.sample->dampings.size(); ++d) {
            const bench::RateLaw& law = s.peak.laws[d];
            fmt::format_to(std::back_inserter(text), "| {} | {} | {:+.1f} % | {} | {} |\n",
                           s.sample->name, s.sample->dampings[d],
                           100 * law.slope * std::pow(0.1, law.exponent) / s.peak.value,
                           price(s, d, 0.05), price(s, d, 0.02));
        }
    return text;
}

/// A row a damping, a column a rate.
template <class Text>
std::string rate_table(const RateSample& sample, const Text& text_of) {
    std::string text = "| damping |";
    for (const double rate : bench::study_rates) text += fmt::format(" {}/s |", rate);
    text += "\n|--:|";
    for (std::size_t k = 0; k < bench::study_rates.size(); ++k) text += "--:|";
    for (const double damping : sample.dampings) {
        text += fmt::format("\n| {} |", damping);
        for (const double rate : bench::study_rates) {
            const RateCell* cell = sample.cell(damping, rate);
            text += cell != nullptr ? fmt::format(" {} |", text_of(*cell)) : " |";
        }
    }
    return text + "\n";
}

std::string sample_section(const RateSample& sample) {
    const auto with_deviation = [](double RateRun::*value, double scale) {
        return [=](const RateCell& cell) {
            const std::string mean =
                fmt::format("{:.1f}{}", scale * cell.mean(value),
                            cell.without_peak() == cell.runs.size() ? "*" : "");
            const auto deviation = cell.deviation(value);
            return deviation ? fmt::format("{} ± {:.1f}", mean, scale * *deviation) : mean;
        };
    };
    const auto percent = [](double RateRun::*value) {
        return [=](const RateCell& cell) { return fmt::format("{:.1f}", 100 * cell.mean(value)); };
    };
    return fmt::format("\n## {}\n\n`{}`\n\nLargest q (kPa):\n\n", sample.name, sample.keys) +
           rate_table(sample, with_deviation(&RateRun::peak, 1e-3)) + "\nE50 (MPa):\n\n" +
           rate_table(sample, with_deviation(&RateRun::E50, 1e-6)) +
           "\nAxial strain at the largest q (%):\n\n" +
           rate_table(sample, percent(&RateRun::strain_at_peak)) +
           "\nShare of the dissipated energy that numerical damping took (%):\n\n" +
           rate_table(sample, percent(&RateRun::damping_share)) +
           "\nKinetic over elastic energy (%):\n\n" +
           rate_table(sample,
                      [](const RateCell& cell) {
                          return fmt::format("{:.2g}", 100 * cell.mean(&RateRun::kinetic_ratio));
                      }) +
           "\nWorst error of the lateral stress (%, RMS up to E50 or the largest q):\n\n" +
           rate_table(sample, [](const RateCell& cell) {
               return fmt::format("{:.2g}", 100 * cell.mean(&RateRun::held));
           });
}

std::string page(const std::vector<Study>& studies) {
    std::string text =
        "# Strain rate and damping\n\n"
        "By `./dev bench rate` at 100 kPa: each sample sheared until `max_axial_strain = \"auto\"` "
        "ends the test, at rates from 0.4 to 0.002/s and local damping of forces and moments from "
        "0.05 to 0.8. A mean ± deviation is that of three tests whose start positions differ by "
        "1e-12 m; below 0.02/s each ran once. A star: no test saw a peak before 15 % of axial "
        "strain, "
        "the value is the largest up to there.\n\n"
        "![Largest deviator stress and share of damping over the rate](rate.png)\n\n"
        "**The limit.** An endlessly slow test has no vibration that damping could take, so there "
        "is one limit for all dampings. Off it, each damping has a power of the rate of its own, "
        "of either sign: q = limit + slope · rate^exponent, exponents from 0.3 to 1.2. Least "
        "squares over all tests of a sample; the intervals are those of the profile likelihood, "
        "with the scatter of single runs as measured, widened where the laws fit worse than that "
        "scatter allows.\n\n";
    text +=
        summary_table(studies) +
        "\nA dash: the tests do not tell it. E50 of samples that harden to the end is read at "
        "half of a noisy plateau.\n\n**What it costs.** By these laws, for the largest q; steps "
        "are those of the whole "
        "test. The limit's own interval comes on top.\n\n" +
        price_table(studies) +
        fmt::format(
            "\n**Quasi-static** is called a test with an inertial number of at most {:g} in "
            "which numerical damping took at most {:g} % of the dissipated energy. Rates and "
            "dampings of the study, and how far the largest q is off the limit:\n\n",
            triaxial::quasi_static_inertial_number, 100 * triaxial::quasi_static_damping_share) +
        quasi_static_table(studies);
    for (const Study& s : studies) text += sample_section(*s.sample);
    return text;
}

std::string csv(const std::vector<Study>& studies) {
    std::string text =
        "sample,damping,strain_rate_per_s,run,spheres,peak_Pa,axial_strain_at_peak,E50_Pa,failure,"
        "inertial_number,damping_share,kinetic_over_elastic_energy,lateral_rms_error,"
        "isotropic_steps,shear_steps\n";
    for (const Study& s : studies)
        for (const RateCell& cell : s.sample->cells)
            for (std::size_t k = 0; k < cell.runs.size(); ++k) {
                const RateRun& r = cell.runs[k];
                fmt::format_to(std::back_inserter(text),
                               "{},{},{},{},{},{:.6g},{:.5f},{:.6g},{},{:.4g},{:.4f},{:.3g},{:.3g},"
                               "{},{}\n",
                               s.sample->name, cell.damping, cell.rate, k, r.spheres, r.peak,
                               r.strain_at_peak, r.E50, r.failure, r.inertial_number,
                               r.damping_share, r.kinetic_ratio, r.held, r.isotropic_steps,
                               r.shear_steps);
            }
    return text;
}

std::string picture(const std::vector<Study>& studies) {
    using triaxial::report::DataBlock;
    DataBlock points, limits;
    std::vector<std::string> names, dampings;
    std::vector<double> counts;
    for (const Study& s : studies) {
        names.push_back(s.sample->name);
        limits.row(s.peak.value / 1e3, s.peak.low / 1e3, s.peak.high / 1e3);
        // The damping's place among those of the first sample is its colour.
        for (const double damping : studies.front().sample->dampings) {
            points.row(std::nan(""), std::nan(""), 0.0, std::nan(""));  // at least one
            for (const RateCell& cell : s.sample->cells)
                if (cell.damping == damping)
                    points.row(cell.rate, cell.mean(&RateRun::peak) / 1e3,
                               cell.deviation(&RateRun::peak).value_or(0) / 1e3,
                               100 * cell.mean(&RateRun::damping_share));
            points.end_part();
        }
        counts.push_back(static_cast<double>(studies.front().sample->dampings.size()));
    }
    for (const double damping : studies.front().sample->dampings)
        dampings.push_back(fmt::format("{}", damping));
    const triaxial::report::Gnuplot gnuplot(bench::gnuplot_templates());
    const int width = 60 + 400 * static_cast<int>(studies.size());
    return gnuplot.png("rate", "rate", {width, 800},
                       {{"points", points},
                        {"limits", limits},
                        {"names", std::span<const std::string>(names)},
                        {"dampings", std::span<const std::string>(dampings)},
                        {"counts", std::span<const double>(counts)},
                        {"samples", static_cast<int>(studies.size())}});
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 4) {
        std::cerr << "usage: grainfield_rate SAMPLES RUNS OUT\n";
        return 2;
    }
    try {
        const std::vector<RateSample> samples = bench::read_rate_runs(arguments[1], arguments[2]);
        if (samples.empty()) throw std::runtime_error("no finished tests");
        std::vector<Study> studies;
        for (const RateSample& sample : samples)
            studies.push_back(
                {&sample, limit_of(sample, &RateRun::peak), limit_of(sample, &RateRun::E50)});
        const fs::path out = arguments[3];
        core::write_file_atomically(out / "rate.csv", csv(studies));
        core::write_file_atomically(out / "rate.md", page(studies));
        core::write_file_atomically(out / "rate.png", picture(studies));
        fmt::print("written: {}\n", (out / "rate.md").string());
    } catch (const std::exception& error) {
        std::cerr << "grainfield_rate: " << error.what() << '\n';
        return 1;
    }
}
