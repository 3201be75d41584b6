#pragma once
// TOML documents as toml++ has them: reading, `--set` over them, and where a value was written, so
// that any later complaint can name file and line. toml++ is large and included by source files
// alone.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace toml {
inline namespace v3 {
class node;
class table;
}  // namespace v3
}  // namespace toml

namespace grainfield::triaxial {

/// Parses TOML text. source: its name in messages. Throws InputError with source, line and column.
toml::table parse_toml(std::string_view text, const std::string& source);

/// Reads and parses a file. Throws FileError where it cannot be read, else as parse_toml.
toml::table read_toml_file(const std::filesystem::path& file);

/// Puts one `key.path=value` of the command line over what is in `root`, table by table. The value
/// is TOML; a bare word that is not TOML is a string. Throws InputError naming
/// "--set key.path=value", also where it has a table and `root` something else.
void put_override(toml::table& root, const std::string& setting);

/// Where a value was written: "config.toml:12" or "--set key=value". Copies of a node forget it.
std::string origin_of(const toml::node& node);

/// Values by dotted path; they stand in the document that they were found in.
using TomlLeaf = std::pair<std::string, const toml::node*>;
using TomlLeaves = std::vector<TomlLeaf>;

/// The values in a table and the tables in it: `"a.b" = 1` and `a.b = 1` are the same.
TomlLeaves leaves(const toml::table& table);

/// The same of a text, each value as toml_text() writes it.
std::map<std::string, std::string> leaf_texts(std::string_view text, const std::string& source);

}  // namespace grainfield::triaxial
