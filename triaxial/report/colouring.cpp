#include "triaxial/report/colouring.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace grainfield::triaxial::report {
namespace {

struct Stop {
    double at;
    Rgb colour;
};
/// Sand to dark earth; its lightness falls steadily.
constexpr std::array<Stop, 5> palette{{{0.0, {0.976, 0.933, 0.831}},
                                       {0.3, {0.898, 0.757, 0.502}},
                                       {0.55, {0.780, 0.533, 0.275}},
                                       {0.8, {0.545, 0.298, 0.149}},
                                       {1.0, {0.275, 0.129, 0.075}}}};
constexpr Rgb even_block{0.870, 0.760, 0.560}, odd_block{0.400, 0.540, 0.640};

Rgb from_palette(double t) {
    for (std::size_t i = 1; i < palette.size(); ++i) {
        if (t <= palette[i].at || i + 1 == palette.size()) {
            const auto& [from, low] = palette[i - 1];
            const auto& [to, high] = palette[i];
            return low.mixed(high, std::clamp((t - from) / (to - from), 0.0, 1.0));
        }
    }
    return palette.back().colour;
}

bool varies(const core::Column<double>& column) {
    const auto [low, high] = std::ranges::minmax(column);
    return high - low > 1e-9 * std::abs(high);
}

}  // namespace

Rgb Rgb::mixed(const Rgb& other, double share) const {
    return {r + share * (other.r - r), g + share * (other.g - g), b + share * (other.b - b)};
}

std::uint32_t Rgb::packed() const {
    const auto byte = [](double v) {
        return static_cast<std::uint32_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
    };
    return byte(r) << 16 | byte(g) << 8 | byte(b);
}

std::vector<ColourBy> colourings(const core::ParticleStore& spheres) {
    std::vector<ColourBy> by;
    if (spheres.size() == 0) return by;
    if (varies(spheres.normal_stiffness) && std::ranges::min(spheres.normal_stiffness) > 0)
        by.push_back(ColourBy::stiffness);
    if (varies(spheres.friction_angle)) by.push_back(ColourBy::friction);
    if (by.empty()) {
        const bool in_blocks = std::ranges::any_of(
            spheres.block, [&](const auto& block) { return block != spheres.block.front(); });
        by.push_back(in_blocks ? ColourBy::block : ColourBy::diameter);
    }
    return by;
}

Colouring::Colouring(const core::ParticleStore& spheres, ColourBy by) : spheres_(spheres), by_(by) {
    if (by == ColourBy::block || spheres.size() == 0) return;
    lowest_ = highest_ = value(0);
    for (std::size_t i = 1; i < spheres.size(); ++i) {
        lowest_ = std::min(lowest_, value(i));
        highest_ = std::max(highest_, value(i));
    }
    if (!(highest_ > lowest_)) highest_ = lowest_ * 1.01 + 1e-12;  // equal spheres
}

double Colouring::value(std::size_t sphere) const {
    switch (by_) {
        case ColourBy::stiffness:
            return spheres_.normal_stiffness[sphere] * 1e-6;
        case ColourBy::friction:
            return spheres_.friction_angle[sphere];
        case ColourBy::diameter:
            return spheres_.radius[sphere] * 2e3;
        case ColourBy::block:
            break;
    }
    return 0;
}

Rgb Colouring::colour(std::size_t sphere) const {
    if (by_ == ColourBy::block) {
        const auto& [i, j, k] = spheres_.block[sphere];
        return ((i + j + k) & 1) == 0 ? even_block : odd_block;
    }
    const double v = value(sphere);
    const double t = logarithmic() ? std::log(v / lowest_) / std::log(highest_ / lowest_)
                                   : (v - lowest_) / (highest_ - lowest_);
    return from_palette(t);
}

Markup Colouring::label() const {
    switch (by_) {
        case ColourBy::stiffness:
            return "Normal stiffness {/:Italic k}_n (MPa), log scale";
        case ColourBy::friction:
            return "Friction angle φ (rad)";
        case ColourBy::diameter:
            return "Diameter (mm)";
        case ColourBy::block:
            break;
    }
    return "";
}

std::string Colouring::in_words() const {
    switch (by_) {
        case ColourBy::stiffness:
            return "coloured by normal stiffness (darker: stiffer)";
        case ColourBy::friction:
            return "coloured by friction angle (darker: rougher)";
        case ColourBy::diameter:
            return "coloured by diameter";
        case ColourBy::block:
            break;
    }
    return "in the colours of a chessboard by block, so that each block and its mirror images "
           "(flip technique) can be told apart";
}

DataBlock Colouring::palette() {
    DataBlock stops;
    for (const auto& [at, c] : report::palette) stops.row(at, c.r, c.g, c.b);
    return stops;
}

}  // namespace grainfield::triaxial::report
