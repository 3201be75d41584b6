// `field`: realizations of the random field on the block grid, as a table or an HDF5 file, and
// what they are worth.

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "randomfield/field_io.hpp"
#include "randomfield/verification/field_error.hpp"
#include "randomfield/verification/verification.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/interrupt.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/terminal_monitor.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/report/field/field_figures.hpp"
#include "triaxial/report/field/field_report.hpp"
#include "triaxial/report/field/field_verdicts.hpp"

namespace grainfield::triaxial {
namespace {

struct FieldArguments {
    std::optional<std::string> config;
    std::optional<std::string>
        realizations;  // as given: a number that does not fit is refused, not cut
    std::string out;
    bool verify = false;

    [[nodiscard]] std::uint64_t count() const {
        if (!realizations) return verify ? 2000 : 1;
        constexpr std::int64_t most = 1'000'000'000;
        const auto least = verify ? static_cast<std::int64_t>(randomfield::least_realizations) : 1;
        std::int64_t count = 0;
        if (!core::parse_number(*realizations, count) || count < least || count > most)
            throw InputError(fmt::format(
                "--realizations = {}: a whole number in [{}, {}] is "
                "expected{}",
                core::shortened(*realizations), least, most, verify ? " with --verify" : ""));
        return static_cast<std::uint64_t>(count);
    }

    [[nodiscard]] bool writes_fields() const {
        const std::string suffix = std::filesystem::path(out).extension().string();
        return !verify || suffix == ".csv" || suffix == ".h5";
    }
    /// Beside the file of fields, or --out itself.
    [[nodiscard]] std::filesystem::path report_folder() const {
        std::filesystem::path path = out;
        if (writes_fields()) path.replace_filename(path.stem().string() + "-verify");
        return path;
    }
};

template <class E, std::size_t n>
std::string_view name_of(E value, const std::array<Named<E>, n>& names) {
    for (const Named<E>& named : names)
        if (named.value == value) return named.name;
    return "?";
}

void print_property(const randomfield::FieldGenerator& generator, randomfield::Property property) {
    if (!generator.options().random(property)) return;
    const report::DisplayUnit unit = report::display_unit(property);
    const randomfield::Moments moments = generator.marginals(property).moments();
    print_row(report::property_name(property),
              fmt::format("mean {:.6g} {}, deviation {:.6g} {} of a cell, predicted{}",
                          moments.mean / unit.size, unit.name, moments.deviation / unit.size,
                          unit.name, generator.conditioning() ? " without data" : ""));
}

void print_fields(const randomfield::FieldGenerator& generator, const FieldArguments& arguments,
                  double seconds) {
    const randomfield::GridSpec& grid = generator.grid();
    const Vec3& edge = grid.cell_size;
    const Vec3& theta = generator.options().correlation_length;
    print_row("grid", fmt::format("{} x {} x {} cells of {:g} x {:g} x {:g} m", grid.cells[0],
                                  grid.cells[1], grid.cells[2], edge.x(), edge.y(), edge.z()));
    print_row("variable", name_of(generator.options().variable, variable_names));
    print_row("method", name_of(generator.options().method, method_names));
    print_row("correlation length",
              fmt::format("{:g}, {:g}, {:g} m", theta.x(), theta.y(), theta.z()));
    print_row("gamma", fmt::format("{:.6g}  variance of a cell's G", generator.gamma()));
    if (generator.options().random(randomfield::Property::normal_stiffness))
        print_row("E[k]/mu", fmt::format("{:.6g}  mean stiffness of a cell{} over that of a point",
                                         generator.stiffness_mean_ratio(),
                                         generator.conditioning() ? ", with the data," : ""));
    print_property(generator, randomfield::Property::friction_angle);
    print_property(generator, randomfield::Property::normal_stiffness);
    if (const auto* conditioning = generator.conditioning())
        print_row("data", fmt::format("{}: {} cells have values", generator.options().data,
                                      conditioning->data().size()));
    print_row("covariance error",
              grid.size() <= randomfield::max_error_cells || generator.generator().known_error()
                  ? fmt::format("{:.2e}  largest, in units of gamma", generator.covariance_error())
                  : fmt::format("not computed above {} cells{}", randomfield::max_error_cells,
                                generator.generator().exact() ? "; the method is exact"
                                                              : "; --verify looks at it by draws"));
    if (arguments.writes_fields()) print_row("realizations", fmt::format("{}", arguments.count()));
    print_row("time", duration_text(seconds));
    if (arguments.writes_fields()) print_row("written", arguments.out);
}

void print_verdicts(const std::vector<report::Verdict>& verdicts) {
    std::size_t outside = 0;
    for (const report::Verdict& verdict : verdicts) {
        write_result(fmt::format("{:<40}{:<9}{}\n", verdict.check,
                                 verdict.inside ? "inside" : "OUTSIDE", verdict.finding));
        outside += verdict.inside ? 0 : 1;
    }
    print_row("verdict", outside == 0 ? "every check is inside its band"
                                      : fmt::format("{} of {} checks are OUTSIDE their band",
                                                    outside, verdicts.size()));
}

void verify_field(const randomfield::FieldGenerator& generator, const FieldArguments& arguments,
                  core::Monitor& monitor) {
    const std::uint64_t count = arguments.count();
    monitor.begin(fmt::format("verifying with {} realizations", count));
    const randomfield::Verification verification = randomfield::verify(generator, count, monitor);
    monitor.begin("drawing the pictures");
    const auto page = write_field_report(arguments.report_folder(), generator, verification);
    print_row("verified with", fmt::format("{} realizations", count));
    print_verdicts(report::verdicts(generator, verification));
    print_row("report", page.string());
}

void run_field(const FieldArguments& arguments, Session& session) {
    const Config config = load_config(arguments.config, session.settings);
    const std::uint64_t count = arguments.count();
    if (arguments.writes_fields()) randomfield::require_field_suffix(arguments.out);
    const auto start = std::chrono::steady_clock::now();
    session.monitor.begin("drawing the field");
    const randomfield::FieldGenerator generator({config.packing.blocks, config.packing.block},
                                                config.field);
    for (const std::string& key : randomfield::unused_keys(config.field)) session.monitor.note(key);
    // Up to here a signal ends the program; now there are files to take away first.
    handle_signals(OnSignal::stop_safely);
    if (arguments.writes_fields())
        randomfield::write_fields(
            arguments.out, generator, count,
            {config.particle.friction_angle, config.particle.normal_stiffness}, session.monitor);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print_fields(generator, arguments, seconds.count());
    if (arguments.verify) verify_field(generator, arguments, session.monitor);
}

}  // namespace

void add_field_command(CommandLine& line) {
    auto arguments = std::make_shared<FieldArguments>();
    ArgumentParser command =
        line.add("field", "Draws realizations of the random field on the grid of blocks.",
                 "grainfield field --set field.variable=friction --realizations 3 --out field.csv",
                 [arguments](Session& session) { run_field(*arguments, session); });
    command.add("config", arguments->config, "Config (TOML); without one the case of Tran et al.");
    command.add("--realizations", arguments->realizations,
                "How many, 1 unless given; with --verify 2000, at least 100");
    command
        .add("--out", arguments->out,
             "File to write, .csv or .h5; with --verify a folder, or such a file, and "
             "the folder NAME-verify beside it")
        .required();
    command.add_flag("--verify", arguments->verify,
                     "Holds realizations against the exact correlation, distribution and variance: "
                     "prints what is inside its band and what is OUTSIDE, and writes "
                     "verification.html with pictures, correlation.csv, histogram.csv, "
                     "variance.csv. A check of a correct field is OUTSIDE once in a hundred; the "
                     "exit code is 0 either way");
}

}  // namespace grainfield::triaxial
