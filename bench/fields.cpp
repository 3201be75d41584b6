// Random fields: every generator over the paper's five correlation lengths and three grids of the
// same sample (1.5 x 3 x 1.5 m, as blocks and finer): set-up, time a field with its normals, and
// the covariance error, computed without sampling; on one thread, in its processor time. Writes
// fields.csv, fields.png and fields.md.

#include <fmt/format.h>
#include <omp.h>
#include <time.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "bench/fields_picture.hpp"
#include "bench/machine.hpp"
#include "bench/statistics.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/files/atomic_file.hpp"
#include "kernels/vector/vector_tables.hpp"
#include "randomfield/covariance/covariance.hpp"
#include "randomfield/generators/generator.hpp"
#include "randomfield/verification/field_error.hpp"
#include "triaxial/cli/argument_parser.hpp"

namespace {

using namespace grainfield;
using randomfield::CellCount;
using randomfield::GridSpec;
using randomfield::Method;

constexpr double paper_lengths[] = {0.01, 0.1, 0.5, 1.0,
                                    10.0};  // theta_y [m]; ten times that in x, z

struct Problem {
    CellCount cells;
    Method method;
    const char* name;
    std::int64_t stage0;  ///< largest stage 0 [cells]
};

constexpr CellCount blocks{6, 12, 6}, fine{12, 24, 12}, finest{48, 96, 48};
const Problem problems[] = {
    {blocks, Method::las, "las", 54},
    {blocks, Method::las_classic, "las-classic", 54},
    {blocks, Method::cholesky, "cholesky", 432},
    {blocks, Method::circulant, "circulant", 0},
    {fine, Method::las, "las", 512},
    {fine, Method::las_classic, "las-classic", 512},
    {fine, Method::cholesky, "cholesky", 3456},
    {fine, Method::circulant, "circulant", 0},
    {finest, Method::las, "las", 512},
    {finest, Method::las_classic, "las-classic", 512},
    {finest, Method::circulant, "circulant", 0},
};

GridSpec grid_of(const CellCount& cells) {
    const double edge = 1.5 / cells[0];
    return {cells, Vec3(edge, edge, edge)};
}

Vec3 theta_of(double theta_y) {
    return {10.0 * theta_y, theta_y, 10.0 * theta_y};
}

/// Processor time of this thread: what else runs on the machine does not count [s].
double seconds_now() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double wall_seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Median seconds of repeated calls on a clock, as many as fit the time.
template <class Action>
double median_seconds(double budget, const Action& action, double (*now)() = seconds_now) {
    std::vector<double> seconds;
    const double start = now();
    while (seconds.size() < 3 || (now() - start < budget && seconds.size() < 2000)) {
        const double before = now();
        action();
        seconds.push_back(now() - before);
    }
    return bench::median(seconds);
}

/// What can be computed without sampling in reasonable time.
std::optional<double> known_error(const randomfield::Generator& generator) {
    if (const auto known = generator.known_error()) return known;
    if (generator.grid().size() > 4096) return std::nullopt;
    return randomfield::covariance_error(generator).covariance;
}

bench::FieldPoint measure(const Problem& problem, double theta_y, double budget) {
    bench::FieldPoint point;
    point.method = problem.name;
    point.cells = problem.cells;
    point.theta_y = theta_y;
    point.stage0 = problem.stage0;
    const GridSpec grid = grid_of(problem.cells);
    const auto make = [&] {
        return randomfield::make_generator(
            grid, {theta_of(theta_y)}, problem.method,
            problem.stage0 > 0 ? std::optional(problem.stage0) : std::nullopt);
    };
    std::unique_ptr<const randomfield::Generator> generator;
    try {
        const double start = seconds_now();
        generator = make();
        const double first = seconds_now() - start;
        point.set_up = first > 0.3 ? first : median_seconds(budget, [&] { make(); });
    } catch (const InputError&) {
        return point;  // refused
    }
    const core::RandomStream random(1, core::Stream::field_friction);
    std::vector<double> normals(generator->normals()), field(grid.size());
    std::uint64_t realization = 0;
    point.normals = median_seconds(budget, [&] { random.normals(realization++, 0, normals); });
    const auto draw = [&] { generator->draw(random, realization++, field); };
    point.field = median_seconds(budget, draw);
    if (problem.cells == finest) {
        omp_set_num_threads(omp_get_num_procs());
        point.field_in_parallel = median_seconds(budget, draw, wall_seconds_now);
        omp_set_num_threads(1);
    }
    point.error = known_error(*generator);
    return point;
}

std::string csv(const std::vector<bench::FieldPoint>& points) {
    std::string text =
        "cells_x,cells_y,cells_z,theta_y_m,method,stage0_cells,set_up_ms,normals_us,field_us,"
        "ns_per_cell,ns_per_cell_all_cores,covariance_error_gamma\n";
    for (const bench::FieldPoint& p : points) {
        text += fmt::format("{},{},{},{:g},{},{},", p.cells[0], p.cells[1], p.cells[2], p.theta_y,
                            p.method, p.stage0);
        const double cells = static_cast<double>(grid_of(p.cells).size());
        text += p.set_up
                    ? fmt::format("{:.3f},{:.2f},{:.2f},{:.2f},{},{}\n", 1e3 * *p.set_up,
                                  1e6 * p.normals, 1e6 * p.field, 1e9 * p.field / cells,
                                  p.field_in_parallel
                                      ? fmt::format("{:.2f}", 1e9 * *p.field_in_parallel / cells)
                                      : "",
                                  p.error ? fmt::format("{:.2e}", *p.error) : "")
                    : "refused,,,,,\n";
    }
    return text;
}

/// The paper's correlation lengths on its blocks, ready to stand in a page.
std::string table(const std::vector<bench::FieldPoint>& points) {
    std::string text =
        "# Random fields of the paper\n\n"
        "The paper is *An Algorithm for the Propagation of Uncertainty in Soils using the Discrete "
        "Element Method* (Tran, Meguid, Chouinard); its equations stand in "
        "[docs/method.md](../../docs/method.md).\n\n"
        "Local averages over blocks of 0.25 m, theta_x = theta_z = 10 theta_y, Markov correlation. "
        "gamma is the variance of a block, rho the correlation with the next block. Errors are the "
        "largest of all covariances, in units of gamma, from at most 54 cells of stage 0 to "
        "6 x 12 x 6, computed without sampling. With the default stage 0 of 512 cells these fields "
        "are exact.\n\n"
        "| theta_y (m) | gamma | rho in x | rho in y | error of `las` | of `las-classic` |\n"
        "|---|---|---|---|---|---|\n";
    for (const double theta_y : paper_lengths) {
        const randomfield::LocalAverageCovariance c(Vec3::Constant(0.25), {theta_of(theta_y)},
                                                    {2, 2, 2});
        const auto error = [&](std::string_view method) {
            for (const bench::FieldPoint& p : points) {
                if (p.cells == blocks && p.theta_y == theta_y && p.method == method)
                    return *p.error;
            }
            return 0.0;
        };
        text += fmt::format("| {:g} | {:.12f} | {:.4f} | {:.4f} | {:.4f} | {:.4f} |\n", theta_y,
                            c.gamma(), c(1, 0, 0) / c.gamma(), c(0, 1, 0) / c.gamma(), error("las"),
                            error("las-classic"));
    }
    return text;
}

std::string default_folder() {
    const char* isa = "scalar";
    for (const kernels::InstructionSet set : kernels::instruction_sets) {
        if (kernels::runs_here(set)) isa = kernels::name(set);
    }
    return "bench/results/" + bench::cpu_name() + "-" + isa;
}

}  // namespace

int main(int argc, char** argv) {
    triaxial::ArgumentParser parser(
        "Random fields: time against covariance error, on one thread; the largest ones on all "
        "cores too.");
    std::filesystem::path out = default_folder();
    bool quick = false;
    parser.add("--out", out, "Folder for the results, " + out.string() + " unless given");
    parser.add_flag("--quick", quick, "The blocks only, and less often");
    if (const auto code = parser.parse_or_print(argc, argv)) return *code;
    omp_set_num_threads(1);
    try {
        std::vector<bench::FieldPoint> points;
        for (const Problem& problem : problems) {
            if (quick && problem.cells != blocks) continue;
            for (const double theta_y : paper_lengths) {
                points.push_back(measure(problem, theta_y, quick ? 0.05 : 0.3));
                std::cout << csv({points.back()}).substr(csv({}).size()) << std::flush;
            }
        }
        std::filesystem::create_directories(out);
        core::write_file_atomically(out / "fields.csv", csv(points));
        core::write_file_atomically(out / "fields.png", bench::fields_picture(points));
        core::write_file_atomically(out.parent_path() / "fields.md", table(points));
    } catch (const std::exception& error) {
        std::cerr << "fields: " << error.what() << "\n";
        return 4;
    }
    return 0;
}
