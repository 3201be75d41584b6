#pragma once
// Reads keys from a TOML tree and remembers which were asked for: what nobody asked for is an
// error, so that a misspelt key never silently leaves a default in place.

#include <set>
#include <string>
#include <string_view>

#include "core/base/errors.hpp"
#include "triaxial/config/key_slot.hpp"
#include "triaxial/config/toml_file.hpp"

namespace grainfield::triaxial {

class TomlReader {
  public:
    /// root: the table to read, which must outlive the reader. source: name of the file in messages
    /// about what is not in it; may be empty. prefix: put before key names in messages.
    TomlReader(const toml::table& root, std::string source, std::string prefix = {});

    /// Sets the key's variable if the key is there. Throws InputError with origin, key, value and
    /// what is allowed.
    void read(const ConfigKey& key);
    /// The same, but InputError where the key is not there.
    void require(const ConfigKey& key);
    /// The value at a dotted path, whatever it is, for the caller to read; nullptr: not there.
    const toml::node* take(std::string_view path);
    /// InputError if the key is there: `why` ends the message.
    void refuse(std::string_view path, std::string_view why) const;

    bool has(std::string_view path) const { return find(path) != nullptr; }
    /// Throws InputError for a key that nobody asked for, with the nearest known one.
    void finish() const;
    /// A complaint that starts with a key's name, with the place of that key put before it. `over`:
    /// values that stand over those of the table, later ones over earlier.
    InputError located(const InputError& error, const TomlLeaves& over = {}) const;
    /// InputError in the words of every other: origin: key = value: expected is expected.
    InputError wrong_value(std::string_view path, const toml::node& value,
                           std::string_view expected) const;

  private:
    const toml::node* find(std::string_view path) const;
    void check_table(const toml::table& table, const std::string& path) const;
    void know(std::string_view path);

    const toml::table& root_;
    std::string source_;
    std::string prefix_;
    std::set<std::string> keys_;    ///< asked for
    std::set<std::string> tables_;  ///< that hold a key asked for
};

}  // namespace grainfield::triaxial
