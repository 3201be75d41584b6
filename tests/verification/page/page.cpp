#include "tests/verification/page/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace grainfield::verify {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* opening =
    "# Verification\n\n"
    "Written by the tests themselves (`./dev verify`); not edited by hand. Each row is a check of\n"
    "a test: what the closed form gives with the parameters of the scene, what the solver gives,\n"
    "and the error, over the exact value or over a physical scale of the case. `double` shows the\n"
    "worst of the reference kernels and of all instruction sets in double precision, `mixed` the\n"
    "worst of all instruction sets in mixed precision; worst is nearest to the tolerance. Where a\n"
    "test checks the same thing several times (times, spheres, sizes) the worst is shown too.\n"
    "Units are SI. Eqs. (n) are those of docs/method.md.\n\n";

/// A row with the worst record of each precision.
struct Row {
    json text;
    std::optional<json> of_double, of_mixed;
};

struct Section {
    std::vector<std::string> order;  // of quantities
    std::map<std::string, Row> rows;
};

/// Error over tolerance [-].
double strain_of(const json& r) {
    const double error = std::abs(r.at("computed").get<double>() - r.at("expected").get<double>());
    const double tolerance = r.at("tolerance");
    return tolerance > 0 ? error / tolerance : (error > 0 ? HUGE_VAL : 0.0);
}

void keep_worst(std::optional<json>& kept, const json& r) {
    if (!kept || strain_of(r) > strain_of(*kept)) kept = r;
}

bool is_mixed(const std::string& kernel) {
    return kernel.ends_with("_mixed");
}

std::string cell(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
        text.insert(at, 1, '\\');
    return text;
}

std::string value_text(const json& r, const char* key) {
    const std::string unit = r.at("unit");
    return fmt::format("{:.7g}{}{}", r.at(key).get<double>(), unit.empty() ? "" : " ", unit);
}

/// A difference as the page shows it: over the scale, or with its unit.
std::string difference_text(const json& r, double difference) {
    double scale = r.at("scale");
    if (scale == 0) scale = std::abs(r.at("expected").get<double>());
    if (scale > 0) return fmt::format("{:.1e}", difference / scale);
    const std::string unit = r.at("unit");
    return fmt::format("{:.1e}{}{}", difference, unit.empty() ? "" : " ", unit);
}

std::string result_cells(const std::optional<json>& r) {
    if (!r) return " | | |";
    const double error =
        std::abs(r->at("computed").get<double>() - r->at("expected").get<double>());
    return fmt::format(" {} | {} | {} |", value_text(*r, "computed"), difference_text(*r, error),
                       difference_text(*r, r->at("tolerance")));
}

std::string row_text(const Row& row) {
    const json& any = row.of_double ? *row.of_double : *row.of_mixed;
    return fmt::format("| {} | {} | {} | {} |{}{} {} |\n", cell(row.text.at("quantity")),
                       cell(row.text.at("closed_form")), cell(row.text.at("source")),
                       value_text(any, "expected"), result_cells(row.of_double),
                       result_cells(row.of_mixed), cell(row.text.at("why")));
}

std::string section_text(const std::string& name, const Section& section, const fs::path& scenes) {
    std::string text = fmt::format("## {}\n\n", name);
    if (fs::exists(scenes / name / "scene.toml"))
        text += fmt::format(
            "`grainfield simulate tests/verification/scenes/{0}/scene.toml --out out/{0}`\n\n",
            name);
    text +=
        "| quantity | closed form | source | exact | double | error | tolerance | mixed | error | "
        "tolerance | tolerance from |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const std::string& quantity : section.order) text += row_text(section.rows.at(quantity));
    return text + "\n";
}

std::string kernels_text(const std::set<std::string>& ran) {
    std::string text;
    for (const std::string& kernel : ran)
        if (kernel != "any") text += (text.empty() ? "" : ", ") + kernel;
    std::string missing;
    for (const std::string isa : {"avx2", "avx512"})
        if (std::none_of(ran.begin(), ran.end(),
                         [&](const std::string& k) { return k.starts_with(isa + "_"); }))
            missing += (missing.empty() ? "" : ", ") + isa;
    return fmt::format(
        "Kernels that ran: {}.{}\n\n", text,
        missing.empty() ? "" : " Skipped, as the machine lacks them: " + missing + ".");
}

}  // namespace

std::string page_of(const fs::path& records, const fs::path& scenes) {
    std::vector<fs::path> files;
    if (fs::is_directory(records))
        for (const auto& entry : fs::directory_iterator(records))
            if (entry.path().extension() == ".json") files.push_back(entry.path());
    if (files.empty()) throw std::runtime_error(records.string() + ": holds no records");
    std::sort(files.begin(), files.end());

    std::map<std::string, Section> of_scenes, others;
    std::set<std::string> kernels;
    std::size_t checks = 0;
    for (const fs::path& file : files) {
        std::ifstream stream(file);
        const json test = json::parse(stream);
        for (const json& r : test.at("records")) {
            const std::string scene = r.at("scene"), quantity = r.at("quantity");
            Section& section =
                (fs::exists(scenes / scene / "scene.toml") ? of_scenes : others)[scene];
            const auto [row, is_new] = section.rows.try_emplace(quantity, Row{r, {}, {}});
            if (is_new) section.order.push_back(quantity);
            const std::string kernel = r.at("kernel");
            keep_worst(is_mixed(kernel) ? row->second.of_mixed : row->second.of_double, r);
            kernels.insert(kernel);
            ++checks;
        }
    }
    std::size_t count = 0;
    for (const auto* group : {&of_scenes, &others})
        for (const auto& [name, section] : *group) count += section.order.size();
    std::string page =
        opening + kernels_text(kernels) + fmt::format("{} rows, {} checks.\n\n", count, checks);
    for (const auto* group : {&of_scenes, &others})
        for (const auto& [name, section] : *group) page += section_text(name, section, scenes);
    page.pop_back();
    return page;
}

std::set<RowName> rows_of_page(const std::string& page) {
    std::set<RowName> names;
    std::istringstream stream(page);
    std::string heading;
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("## ")) heading = line.substr(3);
        if (!line.starts_with("| ")) continue;
        std::string quantity;
        for (std::size_t k = 2; k < line.size() && line.compare(k, 2, " |") != 0; ++k) {
            if (line.compare(k, 2, "\\|") == 0) ++k;
            quantity += line[k];
        }
        if (quantity != "quantity") names.insert({heading, quantity});
    }
    return names;
}

}  // namespace grainfield::verify
