#include "core/files/file_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "core/base/errors.hpp"
#include "core/files/hdf5_reader.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/sphere_file.hpp"
#include "core/files/sphere_formats.hpp"
#include "core/files/table_info.hpp"
#include "core/files/text_file.hpp"
#include "core/state/checkpoint.hpp"

namespace grainfield::core {
namespace {

namespace fs = std::filesystem;

std::string box_text(const char* title, const Box& box) {
    const Vec3 size = box.size();
    return fmt::format(
        "{}: ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m, "
        "{:.6g} x {:.6g} x {:.6g} m\n",
        title, box.lower.x(), box.lower.y(), box.lower.z(), box.upper.x(), box.upper.y(),
        box.upper.z(), size.x(), size.y(), size.z());
}

std::string radii_text(const ParticleStore& s) {
    std::vector<double> radii(s.radius.begin(), s.radius.end());
    const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
    std::nth_element(radii.begin(), middle, radii.end());
    const auto [smallest, largest] = std::minmax_element(s.radius.begin(), s.radius.end());
    return fmt::format("radii: {:.6g} to {:.6g} m, median {:.6g} m\n", *smallest, *largest,
                       *middle);
}

std::string blocks_text(const ParticleStore& s) {
    std::set<BlockIndex> blocks(s.block.begin(), s.block.end());
    blocks.erase(no_block);
    BlockIndex top{0, 0, 0};
    for (const BlockIndex& b : blocks)
        for (std::size_t axis = 0; axis < 3; ++axis) top[axis] = std::max(top[axis], b[axis] + 1);
    return fmt::format("blocks: {}, indices up to {} x {} x {}\n", blocks.size(), top[0], top[1],
                       top[2]);
}

std::string columns_text(const SphereFile& file) {
    std::string text = "columns: x, y, z, radius";
    const auto has_mass = [](double m) { return m > 0; };
    const auto& mass = file.spheres.mass;
    if (std::any_of(mass.begin(), mass.end(), has_mass)) text += ", mass";
    if (file.has_normal_stiffness) text += ", normal stiffness";
    if (file.has_friction_angle) text += ", friction angle";
    if (file.has_velocity) text += ", velocity and spin";
    if (file.has_block) text += ", block";
    return text + "\n";
}

/// One line a key; what is nested is only counted.
std::string json_lines(const nlohmann::json& json) {
    if (!json.is_object())
        return fmt::format("  {} of {} entries\n", json.type_name(), json.size());
    std::string text;
    for (const auto& [key, value] : json.items())
        text += value.is_structured()
                    ? fmt::format("  {}: {} of {} entries\n", key, value.type_name(), value.size())
                    : fmt::format("  {}: {}\n", key, value.dump());
    return text;
}

std::string describe_spheres(const SphereFile& file, const fs::path& path) {
    const ParticleStore& s = file.spheres;
    check_spheres(s, path.string(), file.lines);  // as everybody who reads spheres
    std::string text = fmt::format("sphere file: {} spheres", s.size());
    if (!file.kind.empty()) text += fmt::format(", {}", file.kind);
    if (!file.producer.empty()) text += fmt::format(", by {}", file.producer);
    text += "\n";
    const double solid = s.solid_volume();
    if (file.box) text += box_text("box", *file.box);
    if (s.size() > 0) {
        text += box_text("bounding box of the spheres", bounding_box(s)) + radii_text(s);
        text += fmt::format("solid volume: {:.6g} m3\n", solid);
    }
    if (file.box && file.box->volume() > 0)
        text += fmt::format("porosity in the box: {:.4f}\n", 1.0 - solid / file.box->volume());
    if (file.has_block) text += blocks_text(s);
    text += columns_text(file);
    for (const std::string& note : file.notes) text += fmt::format("note: {}\n", note);
    for (const auto& [name, array] : file.extra)
        text += fmt::format("extra: {}, {} values\n", name, array.values.size());
    if (!file.attributes.empty())
        text += "attributes:\n" + json_lines(nlohmann::json::parse(file.attributes));
    return text;
}

std::string describe_h5(std::string_view image, const fs::path& path) {
    const Hdf5Reader reader(image, path);
    if (reader.has("/VTKHDF")) return describe_spheres(parse_sphere_h5(image, path), path);
    return "HDF5 file\n" + reader.list();
}

std::string describe_csv(std::string_view text, const fs::path& path) {
    LineReader lines(text);
    std::string_view header;
    if (lines.next_content(header) && is_sphere_csv_header(header))
        return describe_spheres(parse_spheres(text, path), path);
    return describe_table(text, path);
}

std::string describe_json(std::string_view text, const fs::path& path) {
    if (nested_too_deep(text))
        throw FileError(fmt::format("{}: not valid here: JSON nested deeper than {} levels",
                                    path.string(), most_json_levels));
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        return fmt::format("JSON: {} keys\n", json.size()) + json_lines(json);
    } catch (const nlohmann::json::exception& error) {
        throw FileError(fmt::format("{}: {}", path.string(), error.what()));
    }
}

/// First-level tables only; reading configs is not this layer's business.
std::string describe_toml(std::string_view text, const fs::path&) {
    std::vector<std::string> tables;
    LineReader lines(text);
    for (std::string_view line; lines.next_content(line);) {
        line = trim(line);
        if (!line.starts_with('[')) continue;
        line.remove_prefix(std::min(line.find_first_not_of('['), line.size()));
        const std::string name(trim(line.substr(0, line.find_first_of(".]"))));
        if (std::find(tables.begin(), tables.end(), name) == tables.end()) tables.push_back(name);
    }
    std::string info = fmt::format("TOML: {} bytes, {} tables\n", text.size(), tables.size());
    for (const std::string& name : tables) info += fmt::format("  [{}]\n", name);
    return info;
}

/// All but the config, which is long.
std::string describe_checkpoint(std::string_view, const fs::path& path) {
    const FoundCheckpoint found = open_checkpoint(path);
    std::string info = "checkpoint, whole; --resume goes on from it\n";
    if (nested_too_deep(found.identity))
        throw FileError(fmt::format("{}: is damaged: nested too deep", path.string()));
    const auto identity = nlohmann::json::parse(found.identity);
    for (const auto& [key, value] : identity.items())
        if (key != "config") info += fmt::format("  {}: {}\n", key, value.dump());
    return info;
}

}  // namespace

std::string describe_file(const fs::path& path) {
    const std::string suffix = path.extension().string();
    std::string (*describe)(std::string_view, const fs::path&) = nullptr;
    if (suffix == ".h5" || suffix == ".vtkhdf") describe = describe_h5;
    if (suffix == ".csv") describe = describe_csv;
    if (suffix == ".json") describe = describe_json;
    if (suffix == ".toml") describe = describe_toml;
    if (suffix == ".bin") describe = describe_checkpoint;
    if (is_foreign_sphere_suffix(suffix))
        describe = [](auto text, auto& p) { return describe_spheres(parse_spheres(text, p), p); };
    if (describe == nullptr)
        throw InputError(
            fmt::format("{}: suffix '{}' is not known; allowed: {}, .json, .toml, .bin",
                        path.string(), suffix, sphere_file_suffixes));
    return describe(read_whole_file(path), path);
}

}  // namespace grainfield::core
