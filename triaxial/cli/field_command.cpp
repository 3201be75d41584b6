// `field`: realizations of the random field on the block grid, as a table or an HDF5 file.

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "core/errors.hpp"
#include "randomfield/field_error.hpp"
#include "randomfield/field_io.hpp"
#include "triaxial/cli/commands.hpp"
#include "triaxial/cli/print_row.hpp"
#include "triaxial/cli/terminal_monitor.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/load_config.hpp"

namespace grainfield::triaxial {
namespace {

struct Arguments {
    std::optional<std::string> config;
    std::int64_t realizations = 1;
    std::string out;
};

template <class E, std::size_t n>
std::string_view name_of(E value, const std::array<Named<E>, n>& names) {
    for (const Named<E>& named : names)
        if (named.value == value) return named.name;
    return "?";
}

void print_results(const randomfield::FieldGenerator& generator, const Arguments& arguments,
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
    print_row("gamma", fmt::format("{:.6f}  variance of a cell's G", generator.gamma()));
    print_row("E[k]/mu", fmt::format("{:.6f}  mean stiffness of a cell over field.stiffness.mean",
                                     generator.stiffness_mean_ratio()));
    if (grid.size() <= randomfield::max_error_cells)
        print_row("covariance error",
                  fmt::format("{:.2e}  largest, in units of gamma", generator.covariance_error()));
    print_row("realizations", fmt::format("{}", arguments.realizations));
    print_row("time", duration_text(seconds));
    print_row("written", arguments.out);
}

void run_field(const Arguments& arguments, Session& session) {
    const Config config = load_config(arguments.config, session.settings);
    if (arguments.realizations < 1)
        throw InputError(fmt::format("--realizations = {}: must be a whole number >= 1",
                                     arguments.realizations));
    const auto start = std::chrono::steady_clock::now();
    session.monitor.begin("drawing the field");
    const randomfield::FieldGenerator generator({config.packing.blocks, config.packing.block},
                                                config.field);
    randomfield::write_fields(arguments.out, generator,
                              static_cast<std::uint64_t>(arguments.realizations),
                              {config.particle.friction_angle, config.particle.normal_stiffness});
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print_results(generator, arguments, seconds.count());
}

}  // namespace

void add_field_command(CLI::App& app, CommandLine& line) {
    auto arguments = std::make_shared<Arguments>();
    CLI::App& command = line.add(
        app, "field", "Draws realizations of the random field on the grid of blocks.",
        "grainfield field --set field.variable=friction --realizations 3 --out field.csv",
        [arguments](Session& session) { run_field(*arguments, session); }, OnSignal::end_at_once);
    command.add_option("config", arguments->config, "Config (TOML); without one the paper's case");
    command.add_option("--realizations", arguments->realizations, "How many, 1 unless given");
    command.add_option("--out", arguments->out, "File to write, .csv or .h5")->required();
}

}  // namespace grainfield::triaxial
