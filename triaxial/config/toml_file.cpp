#include "triaxial/config/toml_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <tuple>

#include "core/base/errors.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

/// Enough for any campaign; keeps `--config /dev/zero` from eating the memory. [bytes]
constexpr std::size_t largest_file = std::size_t{16} << 20;
constexpr std::string_view override_source = "--set ";

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

/// Throws InputError where brackets or dotted keys are nested deeper than any config: what goes
/// through a document calls itself level by level. Reads no more of TOML than where texts and
/// comments end.
void require_shallow(std::string_view text, const std::string& source) {
    constexpr int most_levels = 100;
    int brackets = 0, dots = 0;
    std::size_t line = 1;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (c == '"' || c == '\'') {
            const std::string_view rest = text.substr(k);
            const bool block = rest.starts_with(std::string(3, c));
            const std::string_view end = rest.substr(0, block ? 3 : 1);
            for (k += end.size(); k < text.size() && !text.substr(k).starts_with(end); ++k) {
                if (c == '"' && text[k] == '\\') ++k;
                if (k < text.size() && text[k] == '\n') {
                    ++line;
                    dots = 0;
                    if (!block) break;  // not closed: the parser says so
                }
            }
            k += block ? 2 : 0;
        } else if (c == '#') {
            k = std::min(text.find('\n', k), text.size()) - 1;
        } else if (c == '\n') {
            ++line;
            dots = 0;
        } else if (c == '[' || c == '{') {
            ++brackets;
        } else if (c == ']' || c == '}') {
            --brackets;
        } else if (c == '=' || c == ',') {
            dots = 0;
        } else if (c == '.') {
            ++dots;
        }
        if (brackets > most_levels || dots > most_levels)
            throw InputError(
                fmt::format("{}:{}: nested deeper than {} levels, the most that are "
                            "allowed",
                            source, line, most_levels));
    }
}

toml::table parse_override(const std::string& setting, const std::string& source) {
    const auto equals = setting.find('=');
    const std::string key = trimmed(setting.substr(0, equals));
    const std::string value =
        equals == std::string::npos ? "" : trimmed(setting.substr(equals + 1));
    // A line break or a comment sign in the key would smuggle in other TOML than one assignment.
    if (key.empty() || value.empty() || key.find('#') != std::string::npos ||
        setting.find_first_of("\r\n") != std::string::npos)
        throw InputError(source + ": key.path=value is expected");
    require_shallow(setting, source);
    try {
        std::ignore = toml::parse(key + " = 0");
    } catch (const toml::parse_error&) {
        throw InputError(fmt::format("{}: {} is not a key: key.path=value is expected", source,
                                     toml_string(key)));
    }
    try {
        return toml::parse(key + " = " + value, source);
    } catch (const toml::parse_error& error) {
        if (is_bare_word(value)) return toml::parse(key + " = " + toml_string(value), source);
        throw InputError(
            fmt::format("{}: the value is not valid TOML: {}", source, error.description()));
    }
}

/// Moves the values of `from` over those of `into`, table by table.
void merge(toml::table& into, toml::table& from, const std::string& source) {
    for (auto&& [key, value] : from) {
        toml::node* present = into.get(key.str());
        if (present == nullptr || !value.is_table()) {
            into.insert_or_assign(key.str(), std::move(value));
        } else if (present->is_table()) {
            merge(*present->as_table(), *value.as_table(), source);
        } else {
            throw InputError(
                fmt::format("{}: {} is not a table in {}", source, key.str(), origin_of(*present)));
        }
    }
}

void add_leaves(const toml::table& table, const std::string& path, TomlLeaves& found) {
    for (const auto& [key, value] : table) {
        const std::string full = fmt::format("{}{}{}", path, path.empty() ? "" : ".", key.str());
        if (const toml::table* inner = value.as_table())
            add_leaves(*inner, full, found);
        else
            found.emplace_back(full, &value);
    }
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& source) {
    require_shallow(text, source);
    try {
        return toml::parse(text, source);
    } catch (const toml::parse_error& error) {
        const auto where = error.source().begin;
        throw InputError(fmt::format("{}:{}:{}: not valid TOML: {}", source, where.line,
                                     where.column, error.description()));
    }
}

toml::table read_toml_file(const std::filesystem::path& file) {
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

void put_override(toml::table& root, const std::string& setting) {
    const std::string source = std::string(override_source) + setting;
    toml::table parsed = parse_override(setting, source);
    merge(root, parsed, source);
}

std::string origin_of(const toml::node& node) {
    const toml::source_region& source = node.source();
    if (!source.path) return {};
    // A command line has no lines.
    return source.path->starts_with(override_source)
               ? *source.path
               : fmt::format("{}:{}", *source.path, source.begin.line);
}

TomlLeaves leaves(const toml::table& table) {
    TomlLeaves found;
    add_leaves(table, "", found);
    return found;
}

std::map<std::string, std::string> leaf_texts(std::string_view text, const std::string& source) {
    std::map<std::string, std::string> texts;
    const toml::table document = parse_toml(text, source);
    for (const auto& [path, value] : leaves(document)) texts[path] = toml_text(*value);
    return texts;
}

}  // namespace grainfield::triaxial
