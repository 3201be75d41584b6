#include "core/files/lammps_style.hpp"

#include "core/files/text_file.hpp"

namespace grainfield::core {
namespace {

/// What a style adds to a hybrid's columns; null: it is not known or has data of its own.
const char* columns_in_hybrid(std::string_view style) {
    if (style == "atomic") return "";
    if (style == "sphere" || style == "granular") return "diameter density";
    if (style == "charge") return "q";
    if (style == "bond" || style == "angle" || style == "molecular") return "molecule-ID";
    if (style == "full") return "molecule-ID q";
    if (style == "dipole") return "q mux muy muz";
    return nullptr;
}

bool has_word(std::string_view text, std::string_view wanted) {
    for (std::string_view w = next_word(text); !w.empty(); w = next_word(text))
        if (w == wanted) return true;
    return false;
}

std::optional<LammpsStyle> hybrid_style(std::string_view styles) {
    LammpsStyle hybrid{"atom-ID atom-type x y z", 5, 0, 0, 2, true};
    for (std::string_view style = next_word(styles); !style.empty(); style = next_word(styles)) {
        const char* added = columns_in_hybrid(style);
        if (added == nullptr) return std::nullopt;
        std::string_view names = added;
        for (std::string_view name = next_word(names); !name.empty(); name = next_word(names)) {
            if (has_word(hybrid.layout, name)) continue;  // stands there once
            if (name == "diameter") hybrid.diameter = hybrid.columns;
            if (name == "density") hybrid.density = hybrid.columns;
            hybrid.layout += " " + std::string(name);
            ++hybrid.columns;
        }
    }
    if (hybrid.diameter == 0) return std::nullopt;
    return hybrid;
}

}  // namespace

std::optional<LammpsStyle> lammps_style(std::string_view style) {
    std::string_view rest = style;
    const std::string_view first = next_word(rest);
    if (first == "hybrid") return hybrid_style(rest);
    if (!trim(rest).empty()) return std::nullopt;
    if (first == "sphere" || first == "granular")
        return LammpsStyle{"atom-ID atom-type diameter density x y z"};
    if (first == "bpm/sphere")
        return LammpsStyle{"atom-ID molecule-ID atom-type diameter density x y z", 8, 3, 4, 5};
    return std::nullopt;
}

std::string_view named_style(std::string_view title) {
    constexpr std::string_view key = "atom_style ";
    const std::size_t at = title.find(key);
    if (at == std::string_view::npos) return {};
    const std::string_view rest = title.substr(at + key.size());
    return trim(rest.substr(0, rest.find_first_of(",;")));
}

}  // namespace grainfield::core
