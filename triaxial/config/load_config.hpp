#pragma once
// From a config file and the command line's --set to a checked Config.

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "triaxial/config/config.hpp"

namespace grainfield::triaxial {

/// Tran et al.'s case, with the file's values over it and the overrides (`key.path=value`) over
/// those, later ones winning. Throws InputError (file, line or --set, key, value, what is allowed)
/// and FileError where the file cannot be read.
Config load_config(const std::optional<std::filesystem::path>& file,
                   std::span<const std::string> overrides = {});

/// A config with the keys that file and overrides give, by dotted path.
struct GivenConfig {
    Config config;
    std::set<std::string> given;
};
GivenConfig load_given_config(const std::optional<std::filesystem::path>& file,
                              std::span<const std::string> overrides = {});

/// The config that write_config() wrote as `text`; `source` names it in messages.
Config parse_config(std::string_view text, const std::string& source);

/// One case of a campaign with its whole config.
struct CampaignCase {
    std::string name;
    Config config;
    std::set<std::string> given = {};  ///< keys that file, overrides and case give
    std::set<std::string> swept = {};  ///< those that the sweep or the case itself sets
};

/// The cases of a campaign, each checked as a config of its own: [[montecarlo.case]] crossed with
/// [montecarlo.sweep]; one case `base` where there is neither. Throws as load_config, naming the
/// case.
std::vector<CampaignCase> load_campaign(const std::optional<std::filesystem::path>& file,
                                        std::span<const std::string> overrides = {});

}  // namespace grainfield::triaxial
