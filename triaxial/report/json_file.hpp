#pragma once
// A JSON file with typed access whose errors name the file and the key.

#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainfield::triaxial::report {

class JsonFile {
  public:
    /// Reads `path`. Throws FileError naming it and, where it does not parse, line and column.
    explicit JsonFile(std::filesystem::path path);

    // Keys may be dotted: "field.gamma". Each throws FileError naming file and key where the value
    // is there but of another kind; number() and numbers() also where it is missing.
    double number(std::string_view key) const;
    std::optional<double> optional_number(std::string_view key) const;
    std::optional<std::string> optional_text(std::string_view key) const;
    std::optional<bool> optional_flag(std::string_view key) const;
    std::vector<double> numbers(std::string_view key) const;
    /// The texts of an array; none where there is no such key.
    std::vector<std::string> texts(std::string_view key) const;
    /// The objects in an object, in the order of the file; FileError where there is none.
    std::vector<std::pair<std::string, JsonFile>> members(std::string_view key) const;
    bool has(std::string_view key) const { return find(key) != nullptr; }

    /// Every leaf as (dotted key, value as text), in the order of the file; null is "null".
    std::vector<std::pair<std::string, std::string>> flattened() const;

    const std::filesystem::path& path() const { return path_; }

  private:
    using Node = std::shared_ptr<const nlohmann::ordered_json>;
    JsonFile(std::filesystem::path path, Node root)
        : path_(std::move(path)), root_(std::move(root)) {}
    const nlohmann::ordered_json* find(std::string_view key) const;
    [[noreturn]] void fail(std::string_view key, std::string_view problem) const;

    std::filesystem::path path_;
    Node root_;
};

}  // namespace grainfield::triaxial::report
