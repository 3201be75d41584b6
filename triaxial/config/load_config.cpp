#include "triaxial/config/load_config.hpp"

#include <fmt/format.h>

#include "triaxial/config/campaign_keys.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_reader.hpp"

namespace grainfield::triaxial {
namespace {

TomlValue read_root(const std::optional<std::filesystem::path>& file,
                    std::span<const std::string> overrides) {
    TomlValue root{TomlValue::Table{}, {}};
    if (file) root = read_toml_file(*file);
    for (const std::string& setting : overrides) merge(root, parse_override(setting));
    return root;
}

/// A file named in a config is looked for beside it, one of --set in the current folder; the whole
/// path is kept, so that a resolved config means the same file wherever it is read.
std::string located_file(const std::string& name, const TomlValue& value,
                         const std::string& source) {
    const bool in_file = !source.empty() && value.origin.starts_with(source);
    const auto folder = in_file ? std::filesystem::path(source).parent_path() : "";
    return std::filesystem::absolute(folder / name).lexically_normal().string();
}

/// The config of a tree, and the cases of its campaign.
Config read_config(const TomlValue& root, const std::string& source, std::vector<CaseKeys>& cases) {
    TomlReader reader(root, source);
    Config config;
    for (const ConfigKey& key : config_keys(config)) reader.read(key);
    if (const TomlValue* data = reader.take("field.data"))
        config.field.data = located_file(config.field.data, *data, source);
    cases = read_campaign(reader);
    reader.finish();
    try {
        config.validate();
    } catch (const InputError& error) {
        throw reader.located(error);
    }
    return config;
}

/// A value under a dotted path as nested tables.
TomlValue nested(std::string_view path, const TomlValue& value) {
    const auto dot = path.find('.');
    TomlValue inner = dot == std::string_view::npos ? value : nested(path.substr(dot + 1), value);
    TomlValue::Table table{{std::string(path.substr(0, dot)), std::move(inner)}};
    return {std::move(table), value.origin};
}

}  // namespace

Config load_config(const std::optional<std::filesystem::path>& file,
                   std::span<const std::string> overrides) {
    std::vector<CaseKeys> cases;
    return read_config(read_root(file, overrides), file ? file->string() : "", cases);
}

Config parse_config(std::string_view text, const std::string& source) {
    std::vector<CaseKeys> cases;
    return read_config(parse_toml(text, source), source, cases);
}

std::vector<CampaignCase> load_campaign(const std::optional<std::filesystem::path>& file,
                                        std::span<const std::string> overrides) {
    const TomlValue root = read_root(file, overrides);
    const std::string source = file ? file->string() : "";
    std::vector<CaseKeys> cases, ignored;
    const Config base = read_config(root, source, cases);
    std::vector<CampaignCase> campaign;
    for (const CaseKeys& keys : cases) {
        TomlValue tree = root;
        for (const auto& [path, value] : keys.values) merge(tree, nested(path, value));
        try {
            campaign.push_back({keys.name, read_config(tree, source, ignored)});
        } catch (const InputError& error) {
            throw InputError(fmt::format("case \"{}\": {}", keys.name, error.what()));
        }
        campaign.back().config.montecarlo = base.montecarlo;
    }
    return campaign;
}

}  // namespace grainfield::triaxial
