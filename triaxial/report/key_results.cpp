#include "triaxial/report/key_results.hpp"

#include <fmt/format.h>

#include <numbers>

#include "packing/block.hpp"
#include "triaxial/realization/curve.hpp"
#include "triaxial/report/text.hpp"

namespace grainfield::triaxial::report {
namespace {

std::string degrees_text(double radians) {
    return significant(radians * 180 / std::numbers::pi);
}
std::string percent(double share, int digits = 3) {
    return significant(100 * share, digits) + " %";
}

/// A table that skips what the file does not hold.
class Builder {
  public:
    Builder(std::string title, const JsonFile* file) : table_{std::move(title), {}}, file_(file) {}

    void row(std::string name, std::string value, std::string note = {}) {
        table_.rows.push_back({std::move(name), std::move(value), std::move(note)});
    }
    template <class Format>
    void number(std::string_view key, std::string name, Format format, std::string note = {}) {
        if (file_ == nullptr) return;
        if (const auto value = file_->optional_number(key))
            row(std::move(name), format(*value), std::move(note));
    }
    void text(std::string_view key, std::string name) {
        if (const auto value = file_->optional_text(key)) row(std::move(name), escape(*value));
    }
    Table take() { return std::move(table_); }

  private:
    Table table_;
    const JsonFile* file_;
};

std::string plain(double value) {
    return significant(value);
}

Table results_table(const RunFolder& run) {
    const KeyResults& r = run.results;
    const std::string scatter = "of one run; <code>triaxial --repeats</code> tells its scatter";
    Builder b("Results", &run.summary);
    b.row(
        r.failure == Failure::peak      ? "Peak deviator stress <i>q</i>"
        : r.failure == Failure::plateau ? "Deviator stress <i>q</i> of the plateau"
                                        : "Largest deviator stress <i>q</i>",
        significant(1e-3 * r.peak_deviator_stress) + " kPa",
        r.failure == Failure::strain_limit ? "no peak before the run ended; " + scatter : scatter);
    b.number("smoothed_peak_deviator_stress_Pa", "the same, smoothed over 0.2 % of strain",
             [](double v) { return significant(1e-3 * v) + " kPa"; });
    b.row("Axial strain there", percent(r.axial_strain_at_peak));
    b.row("Secant modulus <i>E</i><sub>50</sub>", significant(1e-6 * r.E50) + " MPa");
    if (r.smoothed_E50 && moduli_differ(r.E50, *r.smoothed_E50))
        b.row("the same, from the smoothed curve", significant(1e-6 * *r.smoothed_E50) + " MPa",
              "the curve is not smooth there");
    b.row("Macroscopic friction angle φ", degrees_text(r.friction_angle) + "°",
          significant(r.friction_angle) + " rad");
    b.row("Confining stress σ<sub>3</sub>", significant(1e-3 * r.confining_stress) + " kPa");
    if (const auto reason = run.summary.optional_text("end_reason"))
        b.row("The run ended because", escape(end_in_words(*reason)));
    return b.take();
}

Table sample_table(const RunFolder& run) {
    Builder b("Sample", &run.summary);
    b.number("particles", "Spheres", count);
    b.number("contacts", "Contacts", count, "when shear began");
    b.number("porosity", "Porosity before compression", plain);
    return b.take();
}

/// Porosities that the block can have, where they are known.
std::string range_of(const RunFolder& run) {
    if (!run.packing) return {};
    const auto densest = run.packing->optional_number("densest_porosity");
    const auto loosest = run.packing->optional_number("loosest_porosity");
    if (!densest || !loosest) return {};
    return fmt::format("this block can have {:.3f} to {:.3f}", *densest, *loosest);
}

Table packing_table(const RunFolder& run) {
    Builder p("As packed", run.packing ? &*run.packing : nullptr);
    p.number("block_spheres", "Spheres of a block", count, "all blocks are images of one");
    p.number(
        "largest_grain_over_block", "Largest grain",
        [](double v) { return significant(v, 2) + " of the block's smallest side"; },
        fmt::format("above {:g} walls and few grains decide the sample", packing::large_grain));
    p.number("block_porosity", "Porosity of the block", plain, range_of(run));
    p.number(
        "relative_density", "Relative density", [](double v) { return percent(v, 2); },
        "by void ratio, between the loosest and the densest state of this block");
    p.number("coordination_number", "Coordination number", plain);
    p.number("mechanical_coordination_number", "Mechanical coordination number (Thornton 2000)",
             plain);
    p.number(
        "rattler_fraction", "Rattlers (fewer than two contacts)",
        [](double v) { return percent(v); }, "by number");
    p.number("rattler_volume_fraction", "Rattlers by volume", [](double v) { return percent(v); });
    p.number("fabric_anisotropy", "Anisotropy of contact normals", plain);
    p.number("K0", "Earth pressure at rest <i>K</i><sub>0</sub>", plain);
    return p.take();
}

Table accuracy_table(const RunFolder& run) {
    const ServoError recorded = servo_error(run.curve, run.results.confining_stress);
    const auto rms = run.summary.optional_number("lateral_stress_rms_error");
    const auto max = run.summary.optional_number("lateral_stress_max_error");
    const std::string from_curve = "; from the records of curve.csv";
    Builder b("Numerical accuracy", &run.summary);
    b.row("Lateral stress off its target, RMS", percent(rms.value_or(recorded.rms)),
          "aim: 0.5 %" + (rms ? "" : from_curve));
    if (recorded.max)
        b.row("the same, largest", percent(max.value_or(*recorded.max)),
              "after 0.1 % of strain; aim: 1 %" + (max ? "" : from_curve));
    else
        b.row("the same, largest", "–", "the run ended before 0.1 % of strain");
    b.number(
        "first_q_minimum_ratio", "Drop of <i>q</i> when shear begins",
        [](double v) { return percent(v); }, "over σ<sub>3</sub>; aim: not below −1 %");
    b.number(
        "energy_closing_error", "Energy ledger closes to", [](double v) { return percent(v, 2); },
        "largest change of the sum over the work put in");
    b.number(
        "lateral_stress_rms_error_to_E50", "RMS up to <i>E</i><sub>50</sub>",
        [](double v) { return percent(v); }, "above 1 %: a warning; above 5 %: no result");
    b.number("lateral_stress_rms_error_to_peak", "RMS up to the largest <i>q</i>",
             [](double v) { return percent(v); });
    b.number(
        "inertial_number", "Inertial number", [](double v) { return significant(v, 3); },
        "of the axial strain rate");
    b.number(
        "damping_share", "Share of numerical damping", [](double v) { return percent(v, 2); },
        "of the energy dissipated in shear, up to the largest <i>q</i>");
    b.number(
        "kinetic_over_elastic_energy", "Kinetic over elastic energy",
        [](double v) { return significant(v, 2); }, "mean over the same");
    if (const auto quasi_static = run.summary.optional_flag("quasi_static"))
        b.row("Quasi-static", *quasi_static ? "yes" : "no",
              "docs/method.md, section 8, has the limits");
    b.number("time_step_s", "Time step", [](double v) { return significant(1e6 * v) + " µs"; });
    b.number("steps", "Steps", count);
    b.text("precision", "Precision");
    return b.take();
}

Table field_table(const RunFolder& run) {
    Builder b("Random field", &run.summary);
    b.number("field.gamma", "Variance of a block’s average γ", plain, "1 is that of a point");
    b.number("field.mean_ratio_cells", "Mean of the blocks over μ", plain, "this realization");
    b.number("field.mean_ratio_expected", "the same, expected", plain,
             "local averages lower it (lognormal stiffness)");
    b.number(
        "field.covariance_error", "Largest covariance error",
        [](double v) { return significant(v, 2); }, "in units of γ");
    if (run.summary.has("field.correlation_length")) {
        std::string lengths;
        for (const double theta : run.summary.numbers("field.correlation_length"))
            lengths += fmt::format("{}{:.4g}", lengths.empty() ? "" : ", ", theta);
        b.row("Correlation lengths θ", lengths + " m");
    }
    return b.take();
}

Table run_table(const RunFolder& run) {
    Builder b("Run", &run.summary);
    for (const auto& [key, value] : run.summary.flattened()) {
        if (!key.starts_with("wall_seconds.")) continue;
        const std::string stage = key.substr(std::string_view("wall_seconds.").size());
        b.number(key, "Wall time, " + escape(stage), duration);
    }
    b.number("particle_steps_per_second", "Sphere-steps per second",
             [](double v) { return significant(1e-6 * v) + " million"; });
    b.text("threads", "Threads");
    b.text("isa", "Instruction set");
    b.text("version", "Grainfield");
    if (const auto hash = run.summary.optional_text("state_hash"))
        b.row("Hash of the final state", "<code>" + escape(*hash) + "</code>");
    return b.take();
}

}  // namespace

std::vector<Table> key_tables(const RunFolder& run) {
    std::vector<Table> tables{results_table(run), accuracy_table(run)};
    if (Table field = field_table(run); !field.rows.empty()) tables.push_back(std::move(field));
    tables.push_back(sample_table(run));
    if (Table packing = packing_table(run); !packing.rows.empty())
        tables.push_back(std::move(packing));
    tables.push_back(run_table(run));
    return tables;
}

std::string outcome(const RunFolder& run) {
    const KeyResults& r = run.results;
    return fmt::format(
        "At {} kPa confining stress the sample {} <b>{} kPa</b> deviator stress at {} axial "
        "strain; <i>E</i><sub>50</sub> is <b>{} MPa</b> and the friction angle <b>{}°</b>.",
        significant(1e-3 * r.confining_stress),
        r.failure == Failure::peak      ? "peaks at"
        : r.failure == Failure::plateau ? "levels off at"
                                        : "shows no peak before the run ends, having reached",
        significant(1e-3 * r.peak_deviator_stress), percent(r.axial_strain_at_peak),
        significant(1e-6 * r.E50), degrees_text(r.friction_angle));
}

}  // namespace grainfield::triaxial::report
