#include "triaxial/config/nearest_key.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace grainfield::triaxial {
namespace {

/// Levenshtein distance: insertions, deletions and replacements from a to b.
std::size_t edits(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row[b.size()];
}

std::string_view last_part(std::string_view key) {
    return key.substr(key.rfind('.') + 1);
}

/// Words in keys of other programs' random fields, and what stands for them here.
constexpr struct {
    std::string_view word, answer;
} absent_features[] = {
    {"nugget",
     "; the field has no nugget: errors of measured values are the column error of field.data"},
    {"angle", "; the axes of correlation are x, y and z, they cannot be turned"},
    {"rotation", "; the axes of correlation are x, y and z, they cannot be turned"},
    {"azimuth", "; the axes of correlation are x, y and z, they cannot be turned"},
    {"dip", "; the axes of correlation are x, y and z, they cannot be turned"},
};

}  // namespace

std::string_view absent_feature(std::string_view unknown) {
    constexpr std::string_view table = "field.";
    if (!unknown.starts_with(table)) return {};
    const std::string_view key = unknown.substr(table.size());
    for (const auto& [word, answer] : absent_features)
        if (key.starts_with(word)) return answer;
    return {};
}

std::optional<std::string> nearest_key(std::string_view unknown,
                                       const std::set<std::string>& known) {
    constexpr std::size_t longest = 200;  // nobody mistypes a key of that length
    if (unknown.size() > longest) return std::nullopt;
    const std::size_t tolerated = std::max<std::size_t>(1, last_part(unknown).size() / 3);
    std::optional<std::string> nearest;
    std::size_t fewest = tolerated + 1;
    for (const std::string& key : known) {
        // The right key in the wrong table counts as one error.
        const std::size_t in_other_table = 1 + edits(last_part(unknown), last_part(key));
        const std::size_t distance = std::min(edits(unknown, key), in_other_table);
        if (distance < fewest) {
            fewest = distance;
            nearest = key;
        }
    }
    return nearest;
}

}  // namespace grainfield::triaxial
