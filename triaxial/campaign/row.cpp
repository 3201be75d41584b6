#include "triaxial/campaign/row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/files/json_text.hpp"

namespace grainfield::triaxial {

bool row_before(const Row& a, const Row& b) {
    return std::tie(a.case_name, a.realization) < std::tie(b.case_name, b.realization);
}

std::string rows_csv(std::span<const Row> rows, const SweptColumns& swept) {
    std::string text =
        "case,realization,seed,status,peak_deviator_stress_Pa,E50_Pa,friction_angle_rad,"
        "axial_strain_at_peak,steps,wall_seconds,state_hash,failure,end_reason";
    for (const std::string& key : swept.keys) text += "," + key;
    text += '\n';
    for (const Row& r : rows) {
        fmt::format_to(std::back_inserter(text), "{},{},{},", r.case_name, r.realization, r.seed);
        if (r.failed)
            fmt::format_to(std::back_inserter(text), "failed,,,,,,{},,,", r.wall_seconds);
        else
            fmt::format_to(std::back_inserter(text), "done,{},{},{},{},{},{},{},{},{}",
                           r.peak_deviator_stress, r.E50, r.friction_angle, r.axial_strain_at_peak,
                           r.steps, r.wall_seconds, r.state_hash, r.failure, r.end_reason);
        if (!swept.keys.empty())
            for (const std::string& value : swept.values.at(r.case_name)) text += "," + value;
        text += '\n';
    }
    return text;
}

std::string quoted_field(std::string text) {
    std::replace(text.begin(), text.end(), '"', '\'');
    std::replace(text.begin(), text.end(), '\n', ' ');
    return '"' + text + '"';
}

std::string warnings_csv(std::span<const Row> rows) {
    std::string text = "case,realization,warning\n";
    for (const Row& r : rows)
        for (const std::string& warning : r.warnings)
            fmt::format_to(std::back_inserter(text), "{},{},{}\n", r.case_name, r.realization,
                           quoted_field(warning));
    return text;
}

std::string row_line(const Row& r) {
    const nlohmann::json json{{"case", r.case_name},
                              {"realization", r.realization},
                              {"seed", r.seed},
                              {"failed", r.failed},
                              {"peak_deviator_stress_Pa", r.peak_deviator_stress},
                              {"E50_Pa", r.E50},
                              {"friction_angle_rad", r.friction_angle},
                              {"axial_strain_at_peak", r.axial_strain_at_peak},
                              {"steps", r.steps},
                              {"wall_seconds", r.wall_seconds},
                              {"state_hash", r.state_hash},
                              {"failure", r.failure},
                              {"end_reason", r.end_reason},
                              {"reason", r.reason},
                              {"warnings", r.warnings}};
    return core::json_text(json);
}

bool parse_row(std::string_view line, Row& row) {
    if (core::nested_too_deep(line)) return false;
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object()) return false;
    try {
        json.at("case").get_to(row.case_name);
        json.at("realization").get_to(row.realization);
        json.at("seed").get_to(row.seed);
        json.at("failed").get_to(row.failed);
        json.at("peak_deviator_stress_Pa").get_to(row.peak_deviator_stress);
        json.at("E50_Pa").get_to(row.E50);
        json.at("friction_angle_rad").get_to(row.friction_angle);
        json.at("axial_strain_at_peak").get_to(row.axial_strain_at_peak);
        json.at("steps").get_to(row.steps);
        json.at("wall_seconds").get_to(row.wall_seconds);
        json.at("state_hash").get_to(row.state_hash);
        row.failure = json.value("failure", "");  // journals of earlier versions lack them
        row.end_reason = json.value("end_reason", "");
        json.at("reason").get_to(row.reason);
        row.warnings = json.value("warnings", std::vector<std::string>{});
    } catch (const nlohmann::json::exception&) {
        return false;
    }
    return true;
}

}  // namespace grainfield::triaxial
