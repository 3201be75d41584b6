#include "triaxial/config/campaign_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/nearest_key.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

/// Tries one value on a config of its own. Values are tried one by one: whether they fit together
/// can only be said of a whole case.
class Trial {
  public:
    Trial() : keys_(config_keys(config_)) {
        std::erase_if(keys_,
                      [](const ConfigKey& key) { return key.path.starts_with("montecarlo."); });
    }

    void check(const TomlReader& reader, const std::string& within, const std::string& path,
               const TomlValue& value) const {
        const auto key = std::ranges::find(keys_, path, &ConfigKey::path);
        if (key == keys_.end()) throw unknown(within, path, value);
        if (!key->slot.set(value))
            throw reader.wrong_value(fmt::format("{}.{}", within, toml_string(path)), value,
                                     key->slot.expected);
    }

  private:
    InputError unknown(const std::string& within, const std::string& path,
                       const TomlValue& value) const {
        std::set<std::string> known;
        for (const ConfigKey& key : keys_) known.insert(key.path);
        const auto nearest = nearest_key(path, known);
        return InputError(fmt::format("{}: {} is not a known key in {}{}", value.origin,
                                      toml_string(path), within,
                                      nearest ? "; did you mean \"" + *nearest + "\"?" : ""));
    }

    Config config_;
    Keys keys_;
};

/// `"field.variable" = …` and `field.variable = …` mean the same: dotted paths of all leaves.
void add_leaves(const TomlValue& table, const std::string& path, TomlValue::Table& leaves) {
    for (const auto& [key, value] : std::get<TomlValue::Table>(table.data)) {
        const std::string full = path.empty() ? key : path + "." + key;
        if (value.is_table())
            add_leaves(value, full, leaves);
        else
            leaves.push_back({full, value});
    }
}

void check_sweep(const TomlReader& reader, const TomlValue& sweep) {
    if (!sweep.is_table())
        throw reader.wrong_value("montecarlo.sweep", sweep, "a table of keys and arrays of values");
    const Trial trial;
    TomlValue::Table leaves;
    add_leaves(sweep, "", leaves);
    for (const auto& [path, values] : leaves) {
        const auto* array = std::get_if<TomlValue::Array>(&values.data);
        if (array == nullptr || array->empty())
            throw reader.wrong_value("montecarlo.sweep." + toml_string(path), values,
                                     "an array of one or more values");
        for (const TomlValue& value : *array) trial.check(reader, "montecarlo.sweep", path, value);
    }
}

void check_case(const TomlReader& document, const TomlValue& one, std::set<std::string>& names) {
    TomlReader reader(one, "", "montecarlo.case.");
    std::string name;
    reader.require({"name", text_slot(name, "a text"), ""});
    if (!names.insert(name).second)
        throw reader.wrong_value("name", *one.find("name"), "a name of its own for every case");
    if (const TomlValue* set = reader.take("set")) {
        if (!set->is_table()) throw reader.wrong_value("set", *set, "a table of keys and values");
        const Trial trial;
        TomlValue::Table leaves;
        add_leaves(*set, "", leaves);
        for (const auto& [path, value] : leaves)
            trial.check(document, "montecarlo.case.set", path, value);
    }
    reader.finish();
}

}  // namespace

void check_campaign(TomlReader& reader) {
    if (const TomlValue* sweep = reader.take("montecarlo.sweep")) check_sweep(reader, *sweep);
    const TomlValue* cases = reader.take("montecarlo.case");
    if (cases == nullptr) return;
    const auto* array = std::get_if<TomlValue::Array>(&cases->data);
    const auto is_table = [](const TomlValue& value) { return value.is_table(); };
    if (array == nullptr || !std::ranges::all_of(*array, is_table))
        throw reader.wrong_value("montecarlo.case", *cases,
                                 "an array of tables [[montecarlo.case]]");
    std::set<std::string> names;
    for (const TomlValue& one : *array) check_case(reader, one, names);
}

}  // namespace grainfield::triaxial
