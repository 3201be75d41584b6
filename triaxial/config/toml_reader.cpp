#include "triaxial/config/toml_reader.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "triaxial/config/nearest_key.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

/// An infinity, or something that is no number, alone or in an array: TOML has both.
bool holds_infinity(const toml::node& value) {
    if (const toml::array* array = value.as_array())
        return std::any_of(array->begin(), array->end(), holds_infinity);
    const auto number = value.value_exact<double>();
    return number && !std::isfinite(*number);
}

}  // namespace

TomlReader::TomlReader(const toml::table& root, std::string source, std::string prefix)
    : root_(root), source_(std::move(source)), prefix_(std::move(prefix)) {}

void TomlReader::read(const ConfigKey& key) {
    const toml::node* value = take(key.path);
    if (value != nullptr && !key.slot.set(*value))
        throw wrong_value(key.path, *value, key.slot.expected);
}

void TomlReader::require(const ConfigKey& key) {
    read(key);
    if (!has(key.path))
        throw InputError(fmt::format("{}: {}{} is missing: {} is expected",
                                     prefix_.empty() ? source_ : origin_of(root_), prefix_,
                                     key.path, key.slot.expected));
}

const toml::node* TomlReader::take(std::string_view path) {
    know(path);
    return find(path);
}

void TomlReader::refuse(std::string_view path, std::string_view why) const {
    if (const toml::node* value = find(path))
        throw InputError(fmt::format("{}: {}{} = {}: {}", origin_of(*value), prefix_, path,
                                     short_text(*value), why));
}

const toml::node* TomlReader::find(std::string_view path) const {
    const toml::node* value = &root_;
    for (std::size_t begin = 0; value != nullptr && begin <= path.size();) {
        const toml::table* table = value->as_table();
        if (table == nullptr) throw wrong_value(path.substr(0, begin - 1), *value, "a table");
        const std::size_t end = std::min(path.find('.', begin), path.size());
        value = table->get(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return value;
}

void TomlReader::know(std::string_view path) {
    keys_.emplace(path);
    for (auto dot = path.find('.'); dot != std::string_view::npos; dot = path.find('.', dot + 1))
        tables_.emplace(path.substr(0, dot));
}

void TomlReader::finish() const {
    check_table(root_, "");
}

void TomlReader::check_table(const toml::table& table, const std::string& path) const {
    for (const auto& [name, value] : table) {
        const std::string key(name.str());
        const std::string before = path.empty() ? "" : path + ".";
        const std::string full = before + key_text(key);
        if (keys_.contains(full)) continue;
        if (tables_.contains(full)) {
            check_table(*value.as_table(), full);
            continue;
        }
        std::set<std::string> known = keys_;
        known.insert(tables_.begin(), tables_.end());
        const auto nearest = nearest_key(before + key, known);
        std::string hint =
            nearest ? fmt::format("; did you mean {}{}?", prefix_, *nearest) : std::string();
        if (const std::string_view lack = absent_feature(full); !lack.empty()) hint = lack;
        throw InputError(
            fmt::format("{}: {}{} is not a known key{}", origin_of(value), prefix_, full, hint));
    }
}

InputError TomlReader::located(const InputError& error, const TomlLeaves& over) const {
    const std::string_view what = error.what();
    const std::string name(what.substr(0, what.find_first_of(" [:=")));
    std::string place = source_;
    const auto present = [&](const std::string& key) {
        const auto top = std::ranges::find(over.rbegin(), over.rend(), key, &TomlLeaf::first);
        return top != over.rend() ? top->second : find(key);
    };
    if (keys_.contains(name)) {
        const std::string table = name.substr(0, name.rfind('.') + 1);
        // A value at odds with a default: then the key to blame is another one of that table.
        for (const std::string& key : keys_)
            if (const toml::node* value = key.starts_with(table) ? present(key) : nullptr)
                place = origin_of(*value);
        if (const toml::node* value = present(name)) place = origin_of(*value);
    }
    return InputError(place.empty() ? std::string(what) : fmt::format("{}: {}", place, what));
}

InputError TomlReader::wrong_value(std::string_view path, const toml::node& value,
                                   std::string_view expected) const {
    return InputError(fmt::format("{}: {}{} = {}: {} is expected{}", origin_of(value), prefix_,
                                  path, short_text(value), expected,
                                  holds_infinity(value) ? ", which inf and nan are not" : ""));
}

}  // namespace grainfield::triaxial
