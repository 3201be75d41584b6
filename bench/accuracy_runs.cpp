#include "bench/accuracy_runs.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "core/base/errors.hpp"
#include "core/kernel_choice.hpp"
#include "triaxial/realization/packing_files.hpp"
#include "triaxial/realization/repeated_start.hpp"

namespace grainfield::bench {
namespace {

// The full sample at COV 2 has a median of max k_n / min k_n of 1900 where blocks are uncorrelated;
// a sample this small falls short of that. Of the first 200 realizations this one differs most
// between its blocks: 144.
constexpr std::int64_t contrast_realization = 81;

/// CPU time of the calling thread [s]: the wall time where nothing else runs, and much less
/// disturbed by what does.
double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Deviator stress at evenly spaced strains up to `last_strain`, interpolated [Pa].
std::vector<double> resample(const std::vector<triaxial::CurvePoint>& curve, double last_strain) {
    std::vector<double> stress(strain_points);
    auto after = curve.begin();
    for (std::size_t k = 0; k < strain_points; ++k) {
        const double strain =
            last_strain * static_cast<double>(k + 1) / static_cast<double>(strain_points);
        while (after + 1 != curve.end() && after->axial_strain < strain) ++after;
        const auto before = after == curve.begin() ? after : after - 1;
        const double span = after->axial_strain - before->axial_strain;
        const double share =
            span > 0 ? std::clamp((strain - before->axial_strain) / span, 0.0, 1.0) : 1.0;
        stress[k] =
            before->deviator_stress + share * (after->deviator_stress - before->deviator_stress);
    }
    return stress;
}

Run run_once(const Task& task) {
    triaxial::Config config = task.series->config;
    config.time.safety = task.setting.safety;
    config.time.mass_scaling = task.setting.mass_scaling;
    triaxial::Sample sample = triaxial::start_of_repeat(task.series->sample, 1, task.repeat);

    Run run;
    core::Monitor silent;
    core::Simulation simulation(triaxial::make_scene(std::move(sample), config),
                                core::choose_kernels(task.setting.solver()));
    const double start = thread_seconds();
    try {
        const triaxial::TestResult result = triaxial::run_test(simulation, config, silent);
        run.cpu_seconds = thread_seconds() - start;
        run.wall_seconds = result.isotropic_seconds + result.shear_seconds;
        run.curve = resample(result.curve, *config.triaxial.max_axial_strain);
        run.peak = result.results.peak_deviator_stress;
        run.peak_strain = result.results.axial_strain_at_peak;
        run.E50 = result.results.E50;
        run.isotropic_steps = result.isotropic_steps;
        run.shear_steps = result.shear_steps;
        run.mean_step = result.mean_step;
        run.inertia_ratio = result.inertia_ratio;
        run.inertial_number = result.inertial_number;
        run.lateral_rms_error = result.lateral_rms_error;
    } catch (const SimulationError& error) {
        run.failure = error.what();
    }
    return run;
}

/// Work of a test, in that of the default setting of "uniform": steps times what a step costs [-].
double expected_work(const Task& task) {
    const Setting& s = task.setting;
    // As measured: cost of a step in that of the mixed kernels, steps before shear in all steps.
    const double step = s.reference_kernels                       ? 3.7
                        : s.precision == core::Precision::double_ ? 1.5
                                                                  : 1.0;
    return task.series->work * step * default_setting.safety / (s.safety * s.mass_scaling);
}

}  // namespace

core::SolverOptions Setting::solver() const {
    if (reference_kernels)
        return {.precision = core::Precision::double_, .isa = kernels::InstructionSet::scalar};
    return {.precision = precision};
}

std::vector<Series> make_series(const std::filesystem::path& packing, double last_strain,
                                core::Monitor& monitor) {
    triaxial::Config config;
    config.packing.seed = 2;  // dense: its peak is clear, and runs scatter little
    config.packing.blocks = {2, 4, 2};
    config.triaxial.max_axial_strain = last_strain;
    if (!std::filesystem::exists(packing)) {
        std::filesystem::create_directories(packing.parent_path());
        triaxial::write_packing(
            packing,
            packing::pack(config.packing, config.grading, triaxial::packing_material(config),
                          config.time, monitor),
            0.0);
    }
    core::SphereFile file = triaxial::read_packing(packing, config);
    std::vector<Series> series;
    series.push_back({"uniform", config, {file.spheres, *file.box}});

    config.field.variable = randomfield::Variable::stiffness;
    config.field.stiffness.cov = 2.0;
    config.field.correlation_length = Vec3(0.5, 0.5, 0.5);  // two blocks [m]
    series.push_back({"contrast", config, {std::move(file.spheres), *file.box}});
    triaxial::map_field(config, contrast_realization, series.back().sample);
    const auto& k = series.back().sample.spheres.normal_stiffness;
    const auto [softest, stiffest] = std::ranges::minmax_element(k);
    series.back().stiffness_contrast = *stiffest / *softest;
    series.back().work = 2.4;  // as measured: shorter steps
    return series;
}

void make_runs(std::vector<Task>& tasks, int workers, core::Monitor& monitor) {
    double work = 0;
    for (const Task& task : tasks) work += expected_work(task);
    std::atomic<std::size_t> next = 0;
    std::mutex mutex;
    std::exception_ptr error;  // the first, of any worker
    std::size_t made = 0;
    double done = 0;
    std::int64_t steps = 0;
    monitor.begin("triaxial tests");
    monitor.progress(0, 0, "");
    const auto worker = [&] {
        omp_set_num_threads(1);  // of the parallel regions that this thread opens
        for (std::size_t k = next++; k < tasks.size(); k = next++) {
            Task& task = tasks[k];
            try {
                task.run = run_once(task);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!error) error = std::current_exception();
                next = tasks.size();
                return;
            }
            const std::lock_guard lock(mutex);
            done += expected_work(task);
            steps += task.run.isotropic_steps + task.run.shear_steps;
            monitor.progress(done / work, steps, fmt::format("run {} of {}", ++made, tasks.size()));
        }
    };
    {
        std::vector<std::jthread> threads;
        for (int k = 0; k < workers; ++k) threads.emplace_back(worker);
    }
    if (error) std::rethrow_exception(error);
}

}  // namespace grainfield::bench
