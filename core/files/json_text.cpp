#include "core/files/json_text.hpp"

#include <nlohmann/json.hpp>
#include <vector>

namespace grainfield::core {

std::string json_text(const nlohmann::json& json) {
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

nlohmann::json json_of_bytes(const std::string& bytes) {
    const nlohmann::json text = bytes;
    try {
        (void)text.dump();
        return text;
    } catch (const nlohmann::json::exception&) {  // not UTF-8
        std::vector<int> numbers;
        for (const char byte : bytes) numbers.push_back(static_cast<unsigned char>(byte));
        return numbers;
    }
}

std::string bytes_of_json(const nlohmann::json& json) {
    if (json.is_string()) return json.get<std::string>();
    std::string bytes;
    for (const int number : json.get<std::vector<int>>()) bytes += static_cast<char>(number);
    return bytes;
}

bool nested_too_deep(std::string_view text) {
    int level = 0;
    bool quoted = false;
    for (std::size_t k = 0; k < text.size(); ++k) {
        const char c = text[k];
        if (quoted && c == '\\')
            ++k;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{') && ++level > most_json_levels)
            return true;
        else if (!quoted && (c == ']' || c == '}'))
            --level;
    }
    return false;
}

}  // namespace grainfield::core
