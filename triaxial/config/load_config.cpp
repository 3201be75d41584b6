#include "triaxial/config/load_config.hpp"

#include "triaxial/config/campaign_keys.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_reader.hpp"

namespace grainfield::triaxial {

Config load_config(const std::optional<std::filesystem::path>& file,
                   std::span<const std::string> overrides) {
    TomlValue root{TomlValue::Table{}, {}};
    if (file) root = read_toml_file(*file);
    for (const std::string& setting : overrides) merge(root, parse_override(setting));

    TomlReader reader(root, file ? file->string() : std::string());
    Config config;
    for (const ConfigKey& key : config_keys(config)) reader.read(key);
    for (const char* later : {"field.cross_correlation", "field.data"})
        reader.refuse(later, "not available in this version");
    check_campaign(reader);
    reader.finish();
    try {
        config.validate();
    } catch (const InputError& error) {
        throw reader.located(error);
    }
    return config;
}

}  // namespace grainfield::triaxial
