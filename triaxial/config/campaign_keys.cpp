#include "triaxial/config/campaign_keys.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <set>

#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/nearest_key.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

/// Each is a whole config.
constexpr std::size_t most_cases = 10'000;

/// Tries one value on a config of its own. Values are tried one by one: whether they fit together
/// can only be said of a whole case.
class Trial {
  public:
    Trial() : keys_(config_keys(config_)) {
        std::erase_if(keys_,
                      [](const ConfigKey& key) { return key.path.starts_with("montecarlo."); });
    }

    void check(const TomlReader& reader, const std::string& within, const std::string& path,
               const toml::node& value) const {
        const auto key = std::ranges::find(keys_, path, &ConfigKey::path);
        if (key == keys_.end()) throw unknown(within, path, value);
        if (!key->slot.set(value))
            throw reader.wrong_value(fmt::format("{}.{}", within, toml_string(path)), value,
                                     key->slot.expected);
    }

  private:
    InputError unknown(const std::string& within, const std::string& path,
                       const toml::node& value) const {
        std::set<std::string> known;
        for (const ConfigKey& key : keys_) known.insert(key.path);
        const auto nearest = nearest_key(path, known);
        return InputError(fmt::format("{}: {} is not a known key in {}{}", origin_of(value),
                                      toml_string(path), within,
                                      nearest ? "; did you mean \"" + *nearest + "\"?" : ""));
    }

    Config config_;
    Keys keys_;
};

/// Names stand in a column of results.csv and in the names of files.
bool is_name(const std::string& name) {
    constexpr std::size_t longest = 200;  // names of files end at 255
    return !name.empty() && name.size() <= longest &&
           std::ranges::all_of(name, [](unsigned char c) {
               return std::isalnum(c) != 0 || std::strchr(" ._+=-", c) != nullptr;
           });
}

std::string shortened_name(const std::string& text) {
    constexpr std::size_t longest = 60;
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

/// A value as part of a case's name: 5x0.5x5 for [5, 0.5, 5].
std::string value_name(const toml::node& value) {
    if (const auto* text = value.as_string()) return text->get();
    const toml::array* array = value.as_array();
    if (array == nullptr) return toml_text(value);
    std::string name;
    for (const toml::node& element : *array)
        name += (name.empty() ? "" : "x") + value_name(element);
    return name;
}

/// One swept key: the name it goes by in the names of cases, and its values.
struct SweptKey {
    std::string path, name;
    std::vector<const toml::node*> values;
};

std::vector<SweptKey> read_sweep(const TomlReader& reader, const toml::node& sweep) {
    if (!sweep.is_table())
        throw reader.wrong_value("montecarlo.sweep", sweep, "a table of keys and arrays of values");
    const Trial trial;
    std::vector<SweptKey> keys;
    std::multiset<std::string> short_names;
    for (const auto& [path, values] : leaves(*sweep.as_table())) {
        const toml::array* array = values->as_array();
        if (array == nullptr || array->empty())
            throw reader.wrong_value("montecarlo.sweep." + toml_string(path), *values,
                                     "an array of one or more values");
        keys.push_back({path, path.substr(path.rfind('.') + 1), {}});
        SweptKey& key = keys.back();
        for (const toml::node& value : *array) {
            trial.check(reader, "montecarlo.sweep", path, value);
            key.values.push_back(&value);
        }
        short_names.insert(keys.back().name);
    }
    for (SweptKey& key : keys)
        if (short_names.count(key.name) > 1) key.name = key.path;
    return keys;
}

CaseKeys read_case(const TomlReader& document, const toml::table& one,
                   std::set<std::string>& names) {
    TomlReader reader(one, "", "montecarlo.case.");
    CaseKeys result;
    reader.require({"name", text_slot(result.name, "a text"), ""});
    if (!is_name(result.name))
        throw reader.wrong_value("name", *one.get("name"),
                                 "a name of at most 200 letters, digits, blanks and . _ + = -");
    if (!names.insert(result.name).second)
        throw reader.wrong_value("name", *one.get("name"), "a name of its own for every case");
    if (const toml::node* set = reader.take("set")) {
        if (!set->is_table()) throw reader.wrong_value("set", *set, "a table of keys and values");
        const Trial trial;
        result.values = leaves(*set->as_table());
        for (const auto& [path, value] : result.values)
            trial.check(document, "montecarlo.case.set", path, *value);
    }
    reader.finish();
    return result;
}

std::vector<CaseKeys> read_cases(const TomlReader& reader, const toml::node& cases) {
    const toml::array* array = cases.as_array();
    const auto is_table = [](const toml::node& value) { return value.is_table(); };
    if (array == nullptr || !std::ranges::all_of(*array, is_table))
        throw reader.wrong_value("montecarlo.case", cases,
                                 "an array of tables [[montecarlo.case]]");
    std::set<std::string> names;
    std::vector<CaseKeys> result;
    for (const toml::node& one : *array)
        result.push_back(read_case(reader, *one.as_table(), names));
    return result;
}

/// Every case with every value of the key.
std::vector<CaseKeys> crossed(const std::vector<CaseKeys>& cases, const SweptKey& key) {
    std::vector<CaseKeys> result;
    for (const CaseKeys& one : cases)
        for (const toml::node* value : key.values) {
            CaseKeys next = one;
            next.name +=
                fmt::format("{}{}={}", next.name.empty() ? "" : " ", key.name, value_name(*value));
            next.values.emplace_back(key.path, value);
            result.push_back(std::move(next));
        }
    return result;
}

}  // namespace

std::string case_file_name(std::string name) {
    std::ranges::replace(name, ' ', '_');
    return name;
}

std::vector<CaseKeys> read_campaign(TomlReader& reader) {
    std::vector<CaseKeys> cases;
    std::vector<SweptKey> sweep;
    if (const toml::node* value = reader.take("montecarlo.sweep"))
        sweep = read_sweep(reader, *value);
    if (const toml::node* value = reader.take("montecarlo.case"))
        cases = read_cases(reader, *value);
    if (cases.empty()) cases.push_back({sweep.empty() ? "base" : "", {}});
    std::size_t count = cases.size();
    for (const SweptKey& key : sweep)
        if ((count *= key.values.size()) > most_cases)
            throw InputError(
                fmt::format("montecarlo.sweep: its keys and [[montecarlo.case]], crossed, are {} "
                            "cases or more: "
                            "at most {} are allowed",
                            count, most_cases));
    for (const SweptKey& key : sweep) cases = crossed(cases, key);
    std::set<std::string> names, files;
    for (const CaseKeys& one : cases) {
        if (!is_name(one.name))
            throw InputError(fmt::format(
                "montecarlo.sweep: a case would be called {}: at most 200 letters, digits, blanks "
                "and . _ + = - are allowed; give cases of such values their names in "
                "[[montecarlo.case]]",
                toml_string(shortened_name(one.name))));
        if (!names.insert(one.name).second)
            throw InputError(fmt::format(
                "montecarlo.sweep: two cases are called \"{}\": a value stands there twice",
                one.name));
        if (!files.insert(case_file_name(one.name)).second)
            throw InputError(
                fmt::format("montecarlo: the case \"{}\" would share its files with another one: "
                            "names must differ in more than blanks and _",
                            one.name));
    }
    return cases;
}

std::vector<std::string> table_texts(const Config& config, const std::vector<std::string>& keys) {
    Config copy = config;  // slots refer to something they may set
    const Keys known = config_keys(copy);
    std::vector<std::string> texts;
    for (const std::string& key : keys) {
        const auto found = std::ranges::find(known, key, &ConfigKey::path);
        const auto value = found == known.end() ? nullptr : found->slot.get();
        std::string& text = texts.emplace_back(value ? value_name(*value) : "");
        std::ranges::replace_if(
            text, [](char c) { return std::strchr(",\"\r\n", c) != nullptr; }, '_');
    }
    return texts;
}

}  // namespace grainfield::triaxial
