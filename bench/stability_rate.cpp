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

constexpr const char* picture = R"(
set multiplot
set logscale x
set xrange [0.007:1.4]
set xtics ('0.01' 0.01, '0.03' 0.03, '0.1' 0.1, '0.3' 0.3, '1' 1)
set xlabel 'Strain rate (1/s)' offset 0,0.3
set key bottom right Left reverse

set lmargin at screen 0.095
set rmargin at screen 0.48
set tmargin at screen 0.97
set bmargin at screen 0.60
set yrange [0:*]
set ylabel 'Peak of q (kPa)' offset 0.5,0
plot 'runs.dat' using 1:2 with points pt 6 ps 1.3 lw 1.2 lc rgb '{soft}' title 'runs', \
     'means.dat' using 1:2:3 with yerrorbars pt 7 ps 1.1 lw 1.8 lc rgb '{main}' title 'mean ± deviation'

set lmargin at screen 0.59
set rmargin at screen 0.98
set ylabel 'E_{{50}} (MPa)'
plot 'runs.dat' using 1:3 with points pt 6 ps 1.3 lw 1.2 lc rgb '{soft}' title 'runs', \
     'means.dat' using 1:4:5 with yerrorbars pt 7 ps 1.1 lw 1.8 lc rgb '{main}' title 'mean ± deviation'

set logscale y
set key top left Left reverse
set lmargin at screen 0.095
set rmargin at screen 0.48
set tmargin at screen 0.48
set bmargin at screen 0.11
set yrange [0.005:200]
set ytics ('0.01' 0.01, '0.1' 0.1, '1' 1, '10' 10, '100' 100)
set ylabel 'Error of the lateral stress (%)' offset 0.5,0
set arrow 1 from graph 0,first 0.5 to graph 1,first 0.5 nohead lw 1 dt 3 lc rgb '{main}' back
set arrow 2 from graph 0,first 1 to graph 1,first 1 nohead lw 1 dt 3 lc rgb '{contrast}' back
plot 'runs.dat' using 1:4 with points pt 7 ps 1.2 lc rgb '{main}' title 'RMS; allowed 0.5', \
     'runs.dat' using 1:5 with points pt 5 ps 1.1 lc rgb '{contrast}' title 'largest; allowed 1'
unset arrow 1
unset arrow 2

set lmargin at screen 0.59
set rmargin at screen 0.98
set yrange [1e-5:1000]
set ytics autofreq
set format y '10^{{%T}}'
set ylabel 'Share (-)'
plot 'runs.dat' using 1:6 with points pt 7 ps 1.2 lc rgb '{main}' title 'mean unbalanced force ratio', \
     'runs.dat' using 1:7 with points pt 5 ps 1.1 lc rgb '{contrast}' title 'kinetic over elastic energy, end', \
     'runs.dat' using 1:8 with points pt 8 ps 1.4 lw 1.5 lc rgb '{ink}' title 'inertial number'
unset multiplot
)";

}  // namespace

void strain_rates(const StabilityRun& run) {
    const core::Scene& sample = run.quick ? run.small : run.large;
    const std::vector<double> rates =
        run.quick ? std::vector<double>{0.3, 1} : std::vector<double>{0.01, 0.03, 0.1, 0.3, 1};
    const int repeats = run.quick ? 2 : 3;
    const triaxial::report::Gnuplot gnuplot;
    std::string csv = header, runs, means;
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
            runs += fmt::format("{} {} {} {} {} {} {} {}\n", rate, 1e-3 * r.peak_deviator_stress,
                                1e-6 * r.E50, 100 * test.lateral_rms_error,
                                100 * test.lateral_max_error, unbalanced.mean(), kinetic,
                                test.inertial_number);
            peak.add(1e-3 * r.peak_deviator_stress);
            modulus.add(1e-6 * r.E50);
            seconds += test.shear_seconds / repeats;
        }
        means += fmt::format("{} {} {} {} {}\n", rate, peak.mean(), peak.deviation(),
                             modulus.mean(), modulus.deviation());
        say(fmt::format(
            "rate {}/s: peak {:.1f} ± {:.1f} kPa, E50 {:.1f} ± {:.1f} MPa, {:.1f} s a "
            "test",
            rate, peak.mean(), peak.deviation(), modulus.mean(), modulus.deviation(), seconds));
    }
    gnuplot.data("runs.dat", runs);
    gnuplot.data("means.dat", means);
    write_results(run, "rate", csv, gnuplot, {1300, 900}, coloured(picture));
}

}  // namespace grainfield::bench
