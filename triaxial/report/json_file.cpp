#include "triaxial/report/json_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/files/json_text.hpp"
#include "core/files/text_file.hpp"

namespace grainfield::triaxial::report {

using nlohmann::ordered_json;

JsonFile::JsonFile(std::filesystem::path path) : path_(std::move(path)) {
    const std::string text = core::read_whole_file(path_);
    if (core::nested_too_deep(text))
        throw FileError(fmt::format("{}: not valid here: JSON nested deeper than {} levels",
                                    path_.string(), core::most_json_levels));
    try {
        root_ = std::make_shared<const ordered_json>(ordered_json::parse(text));
    } catch (const ordered_json::exception& e) {
        throw FileError(fmt::format("{}: not valid JSON: {}", path_.string(), e.what()));
    }
    if (!root_->is_object())
        throw FileError(fmt::format("{}: must hold one JSON object, not {}", path_.string(),
                                    root_->type_name()));
}

const ordered_json* JsonFile::find(std::string_view key) const {
    const ordered_json* node = root_.get();
    for (std::size_t begin = 0; begin <= key.size();) {
        const std::size_t end = std::min(key.find('.', begin), key.size());
        if (!node->is_object()) return nullptr;
        const auto it = node->find(std::string(key.substr(begin, end - begin)));
        if (it == node->end()) return nullptr;
        node = &*it;
        begin = end + 1;
    }
    return node;
}

void JsonFile::fail(std::string_view key, std::string_view problem) const {
    throw FileError(fmt::format("{}: key '{}' {}", path_.string(), key, problem));
}

double JsonFile::number(std::string_view key) const {
    if (find(key) == nullptr) fail(key, "is missing");
    const auto value = optional_number(key);
    if (!value) fail(key, "must be a number, is null");
    return *value;
}

std::optional<double> JsonFile::optional_number(std::string_view key) const {
    const auto* node = find(key);
    if (node == nullptr || node->is_null()) return std::nullopt;
    if (!node->is_number()) fail(key, fmt::format("must be a number, is {}", node->dump()));
    return node->get<double>();
}

std::optional<std::string> JsonFile::optional_text(std::string_view key) const {
    const auto* node = find(key);
    if (node == nullptr || node->is_null()) return std::nullopt;
    if (node->is_string()) return node->get<std::string>();
    if (node->is_structured()) fail(key, "must be text or a number");
    return node->dump();
}

std::optional<bool> JsonFile::optional_flag(std::string_view key) const {
    const auto* node = find(key);
    if (node == nullptr || node->is_null()) return std::nullopt;
    if (!node->is_boolean()) fail(key, fmt::format("must be true or false, is {}", node->dump()));
    return node->get<bool>();
}

std::vector<double> JsonFile::numbers(std::string_view key) const {
    const auto* node = find(key);
    if (node == nullptr) fail(key, "is missing");
    if (!node->is_array()) fail(key, "must be an array of numbers");
    std::vector<double> values;
    values.reserve(node->size());
    for (const auto& item : *node) {
        if (!item.is_number())
            fail(key, fmt::format("must hold numbers only, holds {}", item.dump()));
        values.push_back(item.get<double>());
    }
    return values;
}

std::vector<std::string> JsonFile::texts(std::string_view key) const {
    std::vector<std::string> texts;
    const nlohmann::ordered_json* value = find(key);
    if (value == nullptr) return texts;
    if (!value->is_array()) fail(key, "an array of texts is expected");
    for (const auto& entry : *value) {
        if (!entry.is_string()) fail(key, "an array of texts is expected");
        texts.push_back(entry.get<std::string>());
    }
    return texts;
}

std::vector<std::pair<std::string, JsonFile>> JsonFile::members(std::string_view key) const {
    const nlohmann::ordered_json* value = find(key);
    if (value == nullptr || !value->is_object()) fail(key, "an object is expected");
    std::vector<std::pair<std::string, JsonFile>> entries;
    for (const auto& [name, entry] : value->items()) {
        if (!entry.is_object()) fail(key, "its entries must be objects");
        entries.emplace_back(name, JsonFile(path_, Node(root_, &entry)));
    }
    return entries;
}

std::vector<std::pair<std::string, std::string>> JsonFile::flattened() const {
    std::vector<std::pair<std::string, std::string>> leaves;
    const auto walk = [&](const auto& self, const std::string& prefix,
                          const ordered_json& node) -> void {
        if (node.is_object()) {
            for (const auto& [key, child] : node.items())
                self(self, prefix.empty() ? key : prefix + "." + key, child);
        } else {
            leaves.emplace_back(prefix, node.is_string() ? node.get<std::string>() : node.dump());
        }
    };
    walk(walk, "", *root_);
    return leaves;
}

}  // namespace grainfield::triaxial::report
