#include "triaxial/config/toml_value.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <tuple>
#include <utility>

#include "core/base/errors.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

/// Enough for any campaign; keeps `--config /dev/zero` from eating the memory. [bytes]
constexpr std::size_t largest_file = std::size_t{16} << 20;

/// lines: whether origins carry a line number (a command line has none).
TomlValue converted(const toml::node& node, const std::string& source, bool lines) {
    TomlValue result;
    result.origin = lines ? fmt::format("{}:{}", source, node.source().begin.line) : source;
    if (const auto* table = node.as_table()) {
        TomlValue::Table entries;
        for (const auto& [key, value] : *table)
            entries.push_back({std::string(key.str()), converted(value, source, lines)});
        result.data = std::move(entries);
    } else if (const auto* array = node.as_array()) {
        TomlValue::Array elements;
        for (const auto& element : *array) elements.push_back(converted(element, source, lines));
        result.data = std::move(elements);
    } else if (const auto* truth = node.as_boolean()) {
        result.data = truth->get();
    } else if (const auto* whole = node.as_integer()) {
        result.data = whole->get();
    } else if (const auto* number = node.as_floating_point()) {
        result.data = number->get();
    } else if (const auto* text = node.as_string()) {
        result.data = text->get();
    }
    return result;
}

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

/// Words and paths that a shell user would not think to quote: friction, scalar, ./cpt.csv
bool is_bare_word(std::string_view text) {
    const auto is_letter = [](unsigned char c) { return std::isalpha(c) != 0; };
    return !text.empty() && (is_letter(text[0]) || std::strchr("_./", text[0]) != nullptr) &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) {
               return std::isalnum(c) != 0 || std::strchr("_-./+:", c) != nullptr;
           });
}

void add_leaves(const TomlValue& table, const std::string& path, TomlValue::Table& found) {
    for (const auto& [key, value] : std::get<TomlValue::Table>(table.data)) {
        const std::string full = path.empty() ? key : path + "." + key;
        if (value.is_table())
            add_leaves(value, full, found);
        else
            found.push_back({full, value});
    }
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
    const auto* table = std::get_if<Table>(&data);
    if (table == nullptr) return nullptr;
    for (const TomlEntry& entry : *table)
        if (entry.key == key) return &entry.value;
    return nullptr;
}

TomlValue* TomlValue::find(std::string_view key) {
    return const_cast<TomlValue*>(std::as_const(*this).find(key));
}

TomlValue::Table leaves(const TomlValue& table) {
    TomlValue::Table found;
    add_leaves(table, "", found);
    return found;
}

TomlValue parse_toml(std::string_view text, const std::string& source) {
    try {
        return converted(toml::parse(text, source), source, true);
    } catch (const toml::parse_error& error) {
        const auto where = error.source().begin;
        throw InputError(fmt::format("{}:{}:{}: not valid TOML: {}", source, where.line,
                                     where.column, error.description()));
    }
}

TomlValue read_toml_file(const std::filesystem::path& file) {
    const auto cannot_read = [&file](const char* why) {
        return FileError(fmt::format("cannot read {}: {}", file.string(), why));
    };
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) throw cannot_read("it is a directory");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"),
                                                                 &std::fclose);
    if (!stream) throw cannot_read(std::strerror(errno));

    std::string text;
    char buffer[4096];
    while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, stream.get())) {
        text.append(buffer, n);
        if (text.size() > largest_file) throw cannot_read("it is larger than 16 MiB");
    }
    if (std::ferror(stream.get()) != 0) throw cannot_read(std::strerror(errno));
    return parse_toml(text, file.string());
}

TomlValue parse_override(const std::string& setting) {
    const std::string origin = "--set " + setting;
    const auto equals = setting.find('=');
    const std::string key = trimmed(setting.substr(0, equals));
    const std::string value =
        equals == std::string::npos ? "" : trimmed(setting.substr(equals + 1));
    // A line break or a comment sign in the key would smuggle in other TOML than one assignment.
    if (key.empty() || value.empty() || key.find('#') != std::string::npos ||
        setting.find_first_of("\r\n") != std::string::npos)
        throw InputError(origin + ": key.path=value is expected");
    try {
        std::ignore = toml::parse(key + " = 0");
    } catch (const toml::parse_error&) {
        throw InputError(fmt::format("{}: {} is not a key: key.path=value is expected", origin,
                                     toml_string(key)));
    }
    try {
        return converted(toml::parse(key + " = " + value), origin, false);
    } catch (const toml::parse_error& error) {
        if (is_bare_word(value))
            return converted(toml::parse(key + " = " + toml_string(value)), origin, false);
        throw InputError(
            fmt::format("{}: the value is not valid TOML: {}", origin, error.description()));
    }
}

void merge(TomlValue& into, const TomlValue& from) {
    for (const TomlEntry& entry : std::get<TomlValue::Table>(from.data)) {
        TomlValue* present = into.find(entry.key);
        if (present == nullptr) {
            std::get<TomlValue::Table>(into.data).push_back(entry);
        } else if (!entry.value.is_table()) {
            *present = entry.value;
        } else if (present->is_table()) {
            merge(*present, entry.value);
        } else {
            throw InputError(fmt::format("{}: {} is not a table in {}", from.origin, entry.key,
                                         present->origin));
        }
    }
}

}  // namespace grainfield::triaxial
