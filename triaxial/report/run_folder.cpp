#include "triaxial/report/run_folder.hpp"

#include <fmt/format.h>

#include <array>
#include <tuple>

#include "core/base/errors.hpp"
#include "core/files/energy_csv.hpp"
#include "core/files/sphere_file.hpp"
#include "core/files/text_file.hpp"
#include "triaxial/config/toml_file.hpp"
#include "triaxial/report/number_table.hpp"

namespace grainfield::triaxial::report {
namespace {

double positive(const JsonFile& summary, std::string_view key) {
    const double value = summary.number(key);
    if (!(value > 0))
        throw FileError(fmt::format("{}: key '{}' must be positive, is {}", summary.path().string(),
                                    key, value));
    return value;
}

/// Earlier versions wrote only whether q still rose.
Failure failure(const JsonFile& summary) {
    if (const auto name = summary.optional_text("failure")) {
        const std::optional<Failure> known = failure_of_name(*name);
        if (known) return *known;
        throw FileError(fmt::format(
            "{}: key 'failure' must be \"peak\", \"plateau\" or \"strain-limit\", is \"{}\"",
            summary.path().string(), *name));
    }
    return summary.optional_flag("peak_found").value_or(true) ? Failure::peak
                                                              : Failure::strain_limit;
}

}  // namespace

KeyResults results_of(const JsonFile& summary) {
    KeyResults results;
    results.confining_stress = positive(summary, "confining_stress_Pa");
    results.peak_deviator_stress = positive(summary, "peak_deviator_stress_Pa");
    results.axial_strain_at_peak = positive(summary, "axial_strain_at_peak");
    results.E50 = positive(summary, "E50_Pa");
    results.friction_angle = positive(summary, "friction_angle_rad");
    results.smoothed_E50 = summary.optional_number("smoothed_E50_Pa");
    results.failure = failure(summary);
    return results;
}

namespace {

std::string config_text(const std::filesystem::path& path) {
    std::string text = core::read_whole_file(path);
    try {
        std::ignore = leaf_texts(text, path.string());
    } catch (const InputError& error) {  // it names file, line and column
        throw FileError(error.what());
    }
    return text;
}

std::vector<core::EnergyRow> read_energies(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) return {};  // of an earlier version
    const auto columns = read_number_table(path, core::energy_header);
    std::vector<core::EnergyRow> rows(columns[0].size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        std::array<double, 8> row{};
        for (std::size_t c = 0; c < row.size(); ++c) row[c] = columns[c + 1][r];
        rows[r] = {columns[0][r], core::energy_of_columns(row)};
    }
    return rows;
}

}  // namespace

RunFolder read_run_folder(const std::filesystem::path& dir) {
    if (!std::filesystem::is_directory(dir))
        throw FileError(fmt::format("{}: no such folder", dir.string()));
    RunFolder run{.path = dir,
                  .summary = JsonFile(dir / "summary.json"),
                  .results = {},
                  .curve = read_curve(dir / "curve.csv"),
                  .config = config_text(dir / "config.toml"),
                  .energies = read_energies(dir / "energy.csv"),
                  .packing = std::nullopt,
                  .spheres = {},
                  .box = {}};
    run.results = results_of(run.summary);
    if (std::filesystem::exists(dir / "packing.json")) run.packing.emplace(dir / "packing.json");

    const auto state = dir / "state.h5";
    if (!std::filesystem::exists(state))
        throw FileError(fmt::format("{}: no such file", state.string()));
    auto file = core::read_spheres(state);
    if (file.spheres.size() == 0)
        throw FileError(fmt::format("{}: holds no spheres", state.string()));
    run.spheres = std::move(file.spheres);
    run.box = core::bounding_box(run.spheres);
    return run;
}

MohrCircle read_mohr_circle(const std::filesystem::path& dir) {
    const JsonFile summary(dir / "summary.json");
    const KeyResults results = results_of(summary);
    auto name = dir.filename().empty() ? dir.parent_path().filename() : dir.filename();
    return {results.confining_stress, results.peak_deviator_stress, name.string(),
            soil_of(summary)};
}

std::map<std::string, std::string> soil_of(const JsonFile& summary) {
    std::map<std::string, std::string> soil;
    if (const auto name = summary.optional_text("case"); name && !name->empty())
        soil["random field"] = *name == "deterministic" ? "none" : *name;
    const auto add = [&](const char* key, const char* name, int digits) {
        if (const auto value = summary.optional_number(key))
            soil[name] = fmt::format("{:.{}g}", *value, digits);
    };
    add("field.realization", "realization of the field", 15);
    add("field.seed", "seed of the field", 20);
    add("particles", "spheres", 15);
    add("porosity", "porosity", 4);
    return soil;
}

std::string case_in_words(const JsonFile& summary) {
    const std::string name = summary.optional_text("case").value_or("");
    if (name == "deterministic" || name == "none") return "uniform properties";
    if (name == "friction") return "random friction angle (case A)";
    if (name == "stiffness") return "random stiffness (case B)";
    if (name == "both") return "random friction angle and stiffness";
    return name;
}

}  // namespace grainfield::triaxial::report
