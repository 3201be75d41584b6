#pragma once
// A TOML document as a plain tree whose every value knows where it was written, so that any later
// complaint can name file and line. toml++ itself is seen by toml_value.cpp alone.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace grainfield::triaxial {

struct TomlEntry;

struct TomlValue {
    using Array = std::vector<TomlValue>;
    using Table = std::vector<TomlEntry>;
    /// monostate: a date or time, which no key of ours takes.
    using Data =
        std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Table>;

    Data data;
    std::string origin;  ///< "config.toml:12" or "--set key=value", for messages

    bool is_table() const { return std::holds_alternative<Table>(data); }
    /// Entry of this table; nullptr where there is none or this is no table.
    const TomlValue* find(std::string_view key) const;
    TomlValue* find(std::string_view key);
};

struct TomlEntry {
    std::string key;
    TomlValue value;
};

/// The values in a table and the tables in it, by dotted path: `"a.b" = 1` and `a.b = 1` are the
/// same.
TomlValue::Table leaves(const TomlValue& table);

/// Parses TOML text. source: its name in messages. Throws InputError with source, line and column.
TomlValue parse_toml(std::string_view text, const std::string& source);

/// Reads and parses a file. Throws FileError where it cannot be read, else as parse_toml.
TomlValue read_toml_file(const std::filesystem::path& file);

/// Parses one `key.path=value` of the command line into nested tables. The value is TOML; a bare
/// word that is not TOML is a string. Throws InputError naming "--set key.path=value".
TomlValue parse_override(const std::string& setting);

/// Puts the values of `from` over those of `into`, table by table. Throws InputError where `from`
/// has a table and `into` something else.
void merge(TomlValue& into, const TomlValue& from);

}  // namespace grainfield::triaxial
