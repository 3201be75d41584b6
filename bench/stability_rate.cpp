// Triaxial tests at several strain rates, each repeated from positions that differ by 1e-12 m: the
// spread is the floor under which no difference means anything.

#include <fmt/format.h>

#include <cmath>

#include "bench/stability.hpp"
#include "core/base/random.hpp"
#include "core/kernel_choice.hpp"
#include "triaxial/realization/triaxial_test.hpp"

namespace grainfield::bench {
namespace {

constexpr double perturbation = 1e-12;  // of positions [m]

core::Scene perturbed(const core::Scene& sample, const triaxial::Config& config, int repeat) {
    triaxial::Sample moved;
    moved.spheres = sample.spheres;
    const core::RandomStream random(1, core::Stream::perturbation);
    for (std::size_t i = 0; i < moved.spheres.size(); ++i) {
        const auto k = static_cast<std::uint64_t>(repeat);
        moved.spheres.position.set(
            i, moved.spheres.position[i] + perturbation * Vec3(random.normal(k, 3 * i),
                                                               random.normal(k, 3 * i + 1),
                                                               random.normal(k, 3 * i + 2)));
    }
    for (int a = 0; a < 3; ++a) {
        const auto low = static_cast<std::size_t>(2 * a);
        moved.box.lower[a] = sample.walls[low].point[a];
        moved.box.upper[a] = sample.walls[low + 1].point[a];
    }
    return triaxial::make_scene(std::move(moved), config);
}

/// Mean and standard deviation of the repeats.
struct Spread {
    double sum = 0, squares = 0;
    int count = 0;

    void add(double value) {
        sum += value;
        squares += value * value;
        ++count;
    }
    double mean() const { return sum / count; }
    double deviation() const {
        return count < 2 ? 0 : std::sqrt(std::max(0.0, squares - sum * mean()) / (count - 1));
    }
};

constexpr const char* header =
    "strain_rate_per_s,repeat,spheres,inertial_number,peak_Pa,strain_at_peak,E50_Pa,"
    "lateral_rms_error,lateral_max_error,mean_unbalanced_ratio,kinetic_over_elastic,shear_steps,"
    "mean_step_s,shear_seconds,end\n";

}  // namespace

void strain_rates(const StabilityRun& run) {
    const core::Scene& sample = run.quick ? run.small : run.large;
    const std::vector<double> rates =
        run.quick ? std::vector<double>{0.3, 1} : std::vector<double>{0.01, 0.03, 0.1, 0.3, 1};
    const int repeats = run.quick ? 2 : 3;
    std::string csv = header;
    triaxial::report::DataBlock runs, means;
    for (const double rate : rates) {
        triaxial::Config config;
        config.triaxial.strain_rate = rate;
        config.triaxial.confining_stress = confining_stress;
        Spread peak, modulus;
        double seconds = 0;
        for (int repeat = 0; repeat < repeats; ++repeat) {
            core::Simulation simulation(perturbed(sample, config, repeat),
                                        core::choose_kernels(config.solver));
            core::Monitor silent;
            const triaxial::TestResult test = triaxial::run_test(simulation, config, silent);
            const core::Energy energy = simulation.energy();
            const double kinetic = (energy.kinetic + energy.rotational) /
                                   (energy.elastic_normal + energy.elastic_shear);
            Spread unbalanced;
            for (const triaxial::CurvePoint& point : test.curve)
                unbalanced.add(point.unbalanced_force_ratio);
            const triaxial::CurveResults& r = test.results;
            csv += fmt::format(
                "{},{},{},{:.4g},{:.6g},{:.5g},{:.6g},{:.4g},{:.4g},{:.4g},{:.4g},{},{:.5g},{:.3f},"
                "{}\n",
                rate, repeat, simulation.size(), test.inertial_number, r.peak_deviator_stress,
                r.axial_strain_at_peak, r.E50, test.lateral_rms_error, test.lateral_max_error,
                unbalanced.mean(), kinetic, test.shear_steps, test.mean_step, test.shear_seconds,
                test.end_reason);
            runs.row(rate, 1e-3 * r.peak_deviator_stress, 1e-6 * r.E50,
                     100 * test.lateral_rms_error, 100 * test.lateral_max_error, unbalanced.mean(),
                     kinetic, test.inertial_number);
            peak.add(1e-3 * r.peak_deviator_stress);
            modulus.add(1e-6 * r.E50);
            seconds += test.shear_seconds / repeats;
        }
        means.row(rate, peak.mean(), peak.deviation(), modulus.mean(), modulus.deviation());
        say(fmt::format(
            "rate {}/s: peak {:.1f} ± {:.1f} kPa, E50 {:.1f} ± {:.1f} MPa, {:.1f} s a "
            "test",
            rate, peak.mean(), peak.deviation(), modulus.mean(), modulus.deviation(), seconds));
    }
    write_results(run, "stability_rate", csv, {1300, 900}, {{"runs", runs}, {"means", means}});
}

}  // namespace grainfield::bench
