#include "triaxial/config/load_config.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/files/json_text.hpp"
#include "triaxial/config/campaign_keys.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_reader.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

toml::table read_root(const std::optional<std::filesystem::path>& file,
                      std::span<const std::string> overrides) {
    toml::table root;
    if (file) root = read_toml_file(*file);
    for (const std::string& setting : overrides) put_override(root, setting);
    return root;
}

/// A document read as a config, and the cases of its campaign.
class ConfigReader {
  public:
    /// source: name of the file; empty: there is none.
    ConfigReader(toml::table root, const std::string& source)
        : root_(std::move(root)), source_(source), reader_(root_, source) {
        for (const ConfigKey& key : config_keys(config_)) reader_.read(key);
        if (const toml::node* data = reader_.take("field.data"))
            config_.field.data = located_file(config_.field.data, *data);
        cases_ = read_campaign(reader_);
        reader_.finish();
        validate(config_, {});
    }

    const Config& config() const { return config_; }

    std::set<std::string> given() const {
        std::set<std::string> keys;
        for (const auto& [path, value] : leaves(root_)) keys.insert(path);
        return keys;
    }

    std::vector<CampaignCase> campaign() const {
        std::vector<CampaignCase> campaign;
        for (const CaseKeys& keys : cases_) try {
                campaign.push_back({keys.name, case_config(keys.values), given()});
                for (const auto& [path, value] : keys.values) campaign.back().swept.insert(path);
                campaign.back().given.merge(std::set(campaign.back().swept));
            } catch (const InputError& error) {
                throw InputError(fmt::format("case \"{}\": {}", keys.name, error.what()));
            }
        return campaign;
    }

  private:
    /// The config with the values of a case over it.
    Config case_config(const TomlLeaves& values) const {
        Config config = config_;
        const Keys keys = config_keys(config);
        for (const auto& [path, value] : values) {
            std::ignore = std::ranges::find(keys, path, &ConfigKey::path)->slot.set(*value);
            if (path == "field.data") config.field.data = located_file(config.field.data, *value);
        }
        validate(config, values);
        return config;
    }

    void validate(const Config& config, const TomlLeaves& over) const {
        try {
            config.validate();
        } catch (const InputError& error) {
            throw reader_.located(error, over);
        }
    }

    /// A file named in a config is looked for beside it, one of --set in the current folder; the
    /// whole path is kept, so that a resolved config means the same file wherever it is read.
    std::string located_file(const std::string& name, const toml::node& value) const {
        const bool in_file = !source_.empty() && origin_of(value).starts_with(source_);
        const auto folder = in_file ? std::filesystem::path(source_).parent_path() : "";
        std::string path = std::filesystem::absolute(folder / name).lexically_normal().string();
        // config.toml and checkpoints name the file, and TOML is UTF-8.
        if (!core::json_of_bytes(path).is_string())
            throw InputError(
                fmt::format("{}: field.data = {}: the name of its folder is not UTF-8; "
                            "give a file elsewhere",
                            origin_of(value), toml_string(name)));
        return path;
    }

    toml::table root_;
    std::string source_;
    TomlReader reader_;
    Config config_;
    std::vector<CaseKeys> cases_;
};

}  // namespace

Config load_config(const std::optional<std::filesystem::path>& file,
                   std::span<const std::string> overrides) {
    return ConfigReader(read_root(file, overrides), file ? file->string() : "").config();
}

GivenConfig load_given_config(const std::optional<std::filesystem::path>& file,
                              std::span<const std::string> overrides) {
    const ConfigReader reader(read_root(file, overrides), file ? file->string() : "");
    return {reader.config(), reader.given()};
}

Config parse_config(std::string_view text, const std::string& source) {
    return ConfigReader(parse_toml(text, source), source).config();
}

std::vector<CampaignCase> load_campaign(const std::optional<std::filesystem::path>& file,
                                        std::span<const std::string> overrides) {
    return ConfigReader(read_root(file, overrides), file ? file->string() : "").campaign();
}

}  // namespace grainfield::triaxial
