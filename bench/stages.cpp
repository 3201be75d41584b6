// Micro-benchmarks of the stages of a step and of the random field. The sample is a compressed,
// disordered face-centred cubic packing of unequal spheres: a few contacts a sphere, as in a
// triaxial test, without the minutes that a real packing takes.

#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "core/drive/frequency.hpp"
#include "core/drive/servo.hpp"
#include "core/neighbour_search.hpp"
#include "core/simulation.hpp"
#include "kernels/vector/vector_tables.hpp"
#include "randomfield/block_field.hpp"

namespace {

using namespace grainfield;

constexpr double spacing = 0.04;  // of nearest neighbours [m]

/// n x n x n cubes of four spheres each, radii spread by 10 %, at rest in a box.
core::Scene disordered_lattice(int n) {
    const core::RandomStream random(1, core::Stream::perturbation);
    const double cube = std::sqrt(2.0) * spacing;
    const Vec3 basis[4] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    core::Scene scene;
    scene.spheres.resize(static_cast<std::size_t>(4) * n * n * n);
    std::size_t i = 0;
    for (int c = 0; c < n; ++c)
        for (int b = 0; b < n; ++b)
            for (int a = 0; a < n; ++a)
                for (const Vec3& offset : basis) {
                    scene.spheres.radius[i] = 0.5 * spacing * (0.93 + 0.1 * random.uniform(0, i));
                    scene.spheres.position.set(
                        i, cube * (Vec3(a, b, c) + offset) + Vec3::Constant(0.5 * spacing));
                    scene.spheres.normal_stiffness[i] = 9e8;
                    scene.spheres.friction_angle[i] = 0.6;
                    ++i;
                }
    scene.spheres.set_density(2600);
    scene.damping = {0.2, 0.2};
    core::Wall wall;
    scene.walls = core::box_walls({Vec3::Zero(), Vec3::Constant(cube * (n - 0.5) + spacing)}, wall);
    return scene;
}

/// Sphere-steps and contacts a second beside the time.
void report_rates(benchmark::State& state, const core::Simulation& simulation) {
    state.SetItemsProcessed(state.iterations() *
                            static_cast<std::int64_t>(simulation.spheres().size()));
    state.counters["spheres"] = static_cast<double>(simulation.spheres().size());
    state.counters["contacts"] = static_cast<double>(simulation.contacts().count());
}

/// The whole step, by kernels: list, forces, motion.
void whole_step(benchmark::State& state, const kernels::KernelTable* kernels, int cubes) {
    core::Simulation simulation(disordered_lattice(cubes), *kernels);
    simulation.compute_forces();
    for (auto _ : state) simulation.step(1e-5, [] {});
    report_rates(state, simulation);
}

/// Motion alone.
void advance_only(benchmark::State& state, const kernels::KernelTable* kernels) {
    core::Simulation simulation(disordered_lattice(33), *kernels);
    simulation.compute_forces();
    for (auto _ : state) simulation.advance(1e-12);
    report_rates(state, simulation);
}

/// Forces alone.
void forces_only(benchmark::State& state, const kernels::KernelTable* kernels) {
    core::Simulation simulation(disordered_lattice(33), *kernels);
    for (auto _ : state) simulation.compute_forces();
    report_rates(state, simulation);
}

/// Forces with a neighbour search before each.
void search_and_forces(benchmark::State& state, const kernels::KernelTable* kernels) {
    core::Simulation simulation(disordered_lattice(33), *kernels);
    for (auto _ : state) {
        simulation.change().rebuild_lists();
        simulation.compute_forces();
    }
    report_rates(state, simulation);
}

/// Registers the above for the reference and all kernels that run here.
const bool registered = [] {
    std::vector<const kernels::KernelTable*> tables{&kernels::reference_kernels()};
    for (const kernels::InstructionSet isa : kernels::instruction_sets)
        if (kernels::runs_here(isa))
            for (const auto* table : {kernels::double_table(isa), kernels::mixed_table(isa)})
                tables.push_back(table);
    for (const auto* table : tables) {
        const std::string name = std::string("/") +
                                 (table->reference ? "reference" : kernels::name(table->isa)) +
                                 "/" + table->precision;
        const auto add = [&](const std::string& stage, auto run) {
            benchmark::RegisterBenchmark((stage + name).c_str(), run)
                ->Unit(benchmark::kMillisecond)
                ->UseRealTime();
        };
        for (const int cubes : {10, 33})
            add("whole_step/" + std::to_string(cubes),
                [=](benchmark::State& state) { whole_step(state, table, cubes); });
        add("forces", [=](benchmark::State& state) { forces_only(state, table); });
        add("motion", [=](benchmark::State& state) { advance_only(state, table); });
        add("search_and_forces", [=](benchmark::State& state) { search_and_forces(state, table); });
    }
    return true;
}();

void neighbour_search(benchmark::State& state) {
    const core::Scene scene = disordered_lattice(33);
    std::size_t found = 0;
    for (auto _ : state)
        found = core::find_pairs(scene.spheres.position, scene.spheres.radius, 5e-4).size();
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene.spheres.size()));
    state.counters["pairs"] = static_cast<double>(found);
}
BENCHMARK(neighbour_search)->Unit(benchmark::kMillisecond)->UseRealTime();

void frequency_estimate(benchmark::State& state) {
    core::Simulation simulation(disordered_lattice(static_cast<int>(state.range(0))),
                                kernels::reference_kernels());
    simulation.compute_forces();
    core::FrequencyEstimator estimator;
    for (auto _ : state) benchmark::DoNotOptimize(estimator.estimate(simulation, 1, 5));
    report_rates(state, simulation);
}
BENCHMARK(frequency_estimate)->Arg(33)->Unit(benchmark::kMillisecond)->UseRealTime();

void servos(benchmark::State& state) {
    core::Simulation simulation(disordered_lattice(10), kernels::reference_kernels());  // six walls
    simulation.compute_forces();
    std::vector<core::WallServo> six;
    for (std::size_t w = 0; w < 6; ++w)
        six.emplace_back(w, core::WallServo::Options{.stress = 100e3, .max_speed = 0.1});
    for (auto _ : state)
        for (core::WallServo& servo : six)
            benchmark::DoNotOptimize(servo.steer(simulation, 1.0, 3e-5));
}
BENCHMARK(servos)->Unit(benchmark::kNanosecond);

randomfield::FieldOptions stiffness_field() {
    randomfield::FieldOptions options;
    options.variable = randomfield::Variable::stiffness;
    return options;
}

void field_set_up(benchmark::State& state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(
            randomfield::FieldGenerator({{6, 12, 6}, Vec3::Constant(0.25)}, stiffness_field()));
}
BENCHMARK(field_set_up)->Unit(benchmark::kMillisecond);

void field_draw(benchmark::State& state) {
    const randomfield::FieldGenerator generator({{6, 12, 6}, Vec3::Constant(0.25)},
                                                stiffness_field());
    std::uint64_t realization = 0;
    for (auto _ : state) benchmark::DoNotOptimize(generator.draw(realization++));
}
BENCHMARK(field_draw)->Unit(benchmark::kMicrosecond);

}  // namespace
