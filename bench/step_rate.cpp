// Step rates of whole steps in shear, over instruction sets, precisions, threads and sizes: what
// `dev bench` writes to bench/results/.

#include <fmt/format.h>
#include <omp.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/machine.hpp"
#include "bench/speed_picture.hpp"
#include "bench/statistics.hpp"
#include "bench/stressed_sample.hpp"
#include "core/drive/box.hpp"
#include "core/drive/servo.hpp"
#include "core/files/atomic_file.hpp"
#include "core/simulation.hpp"
#include "kernels/vector/vector_tables.hpp"
#include "packing/isotropic.hpp"
#include "triaxial/cli/argument_parser.hpp"

namespace {

using namespace grainfield;

constexpr double confining_stress = 100e3;  // [Pa]
constexpr double strain_rate = 0.1;         // [1/s]
double step = 3.1e-5;                       // [s]: 0.8 of the limit of this sample

/// A sample in shear: the top moves down, servos hold the sides.
class ShearedSample {
  public:
    ShearedSample(const core::Scene& scene, const kernels::KernelTable& kernels, int threads)
        : simulation_(scene, kernels), threads_(threads) {
        const Vec3 size = core::box_dimensions(simulation_);
        for (const std::size_t wall : {0u, 1u, 4u, 5u})
            servos_.emplace_back(wall, core::WallServo::Options{.stress = confining_stress,
                                                                .max_speed = 0.25 * size.x()});
        const Vec3 low = simulation_.walls()[2].point;
        simulation_.change().add_velocities([&](std::size_t, const Vec3& x) {
            return Vec3(0, -strain_rate * (x.y() - low.y()), 0);
        });
        simulation_.compute_forces(true);
    }

    /// Makes steps; returns the seconds they took, list building and all.
    double run(int steps) {
        omp_set_num_threads(threads_);
        const auto start = std::chrono::steady_clock::now();
        for (int k = 0; k < steps; ++k)
            simulation_.step(step, [&] {
                const Vec3 size = core::box_dimensions(simulation_);
                simulation_.set_wall_velocity(3, Vec3(0, -strain_rate * size.y(), 0));
                for (core::WallServo& servo : servos_)
                    servo.steer(simulation_,
                                core::wall_area(size, static_cast<int>(servo.wall()) / 2), step);
            });
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    const core::Simulation& simulation() const { return simulation_; }
    int threads() const { return threads_; }

  private:
    core::Simulation simulation_;
    int threads_;
    std::vector<core::WallServo> servos_;
};

/// Least traffic of a step in float: a record and its force a sphere, ids, separation and shear a
/// contact [B].
double least_traffic(double spheres, double contacts) {
    return 96 * spheres + 32 * contacts;
}

struct Case {
    std::string name, isa, precision;
    int threads;
    std::unique_ptr<ShearedSample> sample;
    std::vector<double> milliseconds;
};

constexpr const char* header =
    "sample,spheres,contacts,isa,precision,threads,ms_per_step,sphere_steps_per_s,contacts_per_s,"
    "least_traffic_B,triad_B_per_s,ratio_to_floor,traffic_B,share_of_triad,evaluated_over_contacts,"
    "list_builds_per_1000_steps,searches_per_1000_steps,renewals_per_1000_steps,memory_B_per_"
    "sphere\n";

struct Measured {
    std::string rows;  ///< of the CSV file
    std::vector<bench::SpeedPoint> points;
};

/// Runs all cases in turns, so that what else the machine does hits them alike. `before` is the
/// process's memory before they were made [B].
Measured measure(std::vector<Case>& cases, int rounds, int steps, double triad,
                 std::size_t before) {
    for (Case& c : cases) c.sample->run(300);  // the jolt of the start dies away
    std::vector<std::int64_t> builds, searches, renewals;
    for (const Case& c : cases) {
        builds.push_back(c.sample->simulation().stats().list_builds());
        searches.push_back(c.sample->simulation().stats().searches());
        renewals.push_back(c.sample->simulation().stats().partial_rebuilds());
    }
    for (int r = 0; r < rounds; ++r)
        for (Case& c : cases) c.milliseconds.push_back(1e3 * c.sample->run(steps) / steps);
    const double grown = static_cast<double>(bench::bytes_in_use()) - static_cast<double>(before);
    Measured measured;
    for (std::size_t k = 0; k < cases.size(); ++k) {
        const Case& c = cases[k];
        const core::Simulation& sim = c.sample->simulation();
        const double ms = bench::median(c.milliseconds);
        const auto spheres = static_cast<double>(sim.size());
        const auto contacts = static_cast<double>(sim.contacts().count());
        const double traffic = least_traffic(spheres, contacts);
        const core::StepCost cost = sim.stats().step_cost();
        const double thousands = rounds * steps / 1e3;
        const double memory = grown / static_cast<double>(cases.size()) / spheres;
        measured.points.push_back({c.isa, c.precision, c.threads, spheres, ms, memory});
        measured.rows += fmt::format(
            "{},{},{},{},{},{},{:.4f},{:.4g},{:.4g},{:.4g},{:.4g},{:.2f},{:.4g},{:.3f},{:.4f},{:."
            "1f},"
            "{:.1f},{:.1f},{:.0f}\n",
            c.name, sim.size(), sim.contacts().count(), c.isa, c.precision, c.threads, ms,
            1e3 * spheres / ms, 1e3 * contacts / ms, traffic, triad, ms / (1e3 * traffic / triad),
            cost.bytes, cost.bytes / (1e-3 * ms) / triad,
            static_cast<double>(cost.evaluated) / contacts,
            static_cast<double>(sim.stats().list_builds() - builds[k]) / thousands,
            static_cast<double>(sim.stats().searches() - searches[k]) / thousands,
            static_cast<double>(sim.stats().partial_rebuilds() - renewals[k]) / thousands, memory);
        fmt::print("{:>10} {:>8} spheres  {:>6} {:>6} {} threads  {:8.3f} ms a step\n", c.name,
                   sim.size(), c.isa, c.precision, c.threads, ms);
    }
    return measured;
}

Case make_case(const std::string& name, const core::Scene& scene,
               const kernels::KernelTable& kernels, int threads) {
    return {name,
            kernels::name(kernels.isa),
            kernels.precision,
            threads,
            std::make_unique<ShearedSample>(scene, kernels, threads),
            {}};
}

/// The best mixed kernels of this machine.
const kernels::KernelTable& best() {
    const kernels::KernelTable* table = nullptr;
    for (const auto isa : kernels::instruction_sets)
        if (kernels::runs_here(isa) && kernels::mixed_table(isa)) table = kernels::mixed_table(isa);
    return *table;
}

void step_rates(const core::Scene& full, const std::filesystem::path& out, int rounds,
                double triad) {
    const std::size_t before = bench::bytes_in_use();
    std::vector<Case> cases;
    cases.push_back(make_case("full", full, kernels::reference_kernels(), 1));
    cases.push_back(make_case("full", full, kernels::reference_kernels(), 2));
    for (Case& c : cases) c.isa = "reference";
    for (const auto isa : kernels::instruction_sets) {
        if (!kernels::runs_here(isa)) {
            fmt::print("{}: not run, this machine lacks it\n", kernels::name(isa));
            continue;
        }
        for (const auto* table : {kernels::mixed_table(isa), kernels::double_table(isa)})
            for (const int threads : {1, 2})
                cases.push_back(make_case("full", full, *table, threads));
    }
    const Measured measured = measure(cases, rounds, 50, triad, before);
    core::write_file_atomically(out / "step_rate.csv", header + measured.rows);
    core::write_file_atomically(out / "step_rate.png", bench::rate_picture(measured.points));
}

/// The sample between walls that stand still, as the peers run it.
void at_rest(const core::Scene& full) {
    const std::size_t before = bench::bytes_in_use();
    core::Simulation simulation(full, best());
    simulation.compute_forces();
    const auto steps = [&](int n) {
        const auto start = std::chrono::steady_clock::now();
        for (int k = 0; k < n; ++k) simulation.step(step, [] {});
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    steps(20);
    const double ms = 1e3 * steps(200) / 200;
    fmt::print("Grainfield  {:8.2f} ms a step ({}, {}), {:.0f} B a sphere\n", ms,
               kernels::name(best().isa), best().precision,
               static_cast<double>(bench::bytes_in_use() - before) /
                   static_cast<double>(full.spheres.size()));
}

void sizes(const core::Scene& full, const std::filesystem::path& out, int rounds, double triad) {
    std::string rows = header;
    std::vector<bench::SpeedPoint> points;
    const auto add = [&](const std::string& name, const core::Scene& scene) {
        const std::size_t before = bench::bytes_in_use();
        std::vector<Case> cases;
        cases.push_back(make_case(name, scene, best(), 2));
        const Measured measured = measure(cases, rounds, 50, triad, before);
        rows += measured.rows;
        points.push_back(measured.points.front());
    };
    add("2x4x2", bench::part(full, {2, 4, 2}));
    add("6x12x6", full);
    add("12x24x12", bench::mirrored(full, {2, 2, 2}));
    core::write_file_atomically(out / "size.csv", rows);
    core::write_file_atomically(out / "size.png", bench::size_picture(points));
}

}  // namespace

int main(int argc, char** argv) {
    triaxial::ArgumentParser parser("Step rates of whole steps in shear.");
    std::filesystem::path out = "bench/results", sample = "build/bench/full-100kPa.h5";
    int rounds = 9;
    bool large = false, quick = false;
    parser.add("--out", out, "Folder for the CSV files").show_default();
    parser.add("--sample", sample, "The full sample at 100 kPa (.h5); made if it is not there")
        .show_default();
    parser.add("--rounds", rounds, "Rounds of 50 steps; medians are taken over them")
        .range(1, 1000)
        .show_default();
    parser.add("--step", step, "Time step [s]").show_default();
    parser.add_flag("--quick", quick,
                    "Only the default kernels at rest; prints one line, writes nothing");
    parser.add_flag("--sizes", large, "Also other sizes, up to 1.2 million spheres");
    if (const auto code = parser.parse_or_print(argc, argv)) return *code;
    try {
        if (quick) {
            at_rest(bench::full_sample(sample));
            return 0;
        }
        const double triad = bench::triad_bandwidth(std::size_t{24} << 20);
        fmt::print("{}, triad over 24 MB: {:.1f} GB/s\n", bench::cpu_name(), triad / 1e9);
        const core::Scene full = bench::full_sample(sample);
        const std::filesystem::path folder =
            out / (bench::cpu_name() + "-" + kernels::name(best().isa));
        std::filesystem::create_directories(folder);
        step_rates(full, folder, rounds, triad);
        if (large) sizes(full, folder, rounds, triad);
        fmt::print("written to {}\n", folder.string());
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
