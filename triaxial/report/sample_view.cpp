#include "triaxial/report/sample_view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace grainfield::triaxial::report {
namespace {

/// Cells of the picture plane that nearer discs already fill.
class Coverage {
  public:
    Coverage(double left, double bottom, double width, double height, double cell)
        : left_(left),
          bottom_(bottom),
          cell_(cell),
          columns_(static_cast<std::ptrdiff_t>(width / cell) + 1),
          rows_(static_cast<std::ptrdiff_t>(height / cell) + 1),
          filled_(static_cast<std::size_t>(columns_ * rows_), 0) {}

    /// Fills the disc; true where any of its cells was free.
    bool fill(const Disc& disc) {
        bool seen = false;
        const std::ptrdiff_t first = row(disc.y - disc.radius), last = row(disc.y + disc.radius);
        for (std::ptrdiff_t j = first; j <= last; ++j) {
            const double off = bottom_ + (static_cast<double>(j) + 0.5) * cell_ - disc.y;
            const double half = std::sqrt(std::max(0.0, disc.radius * disc.radius - off * off));
            const std::ptrdiff_t end = column(disc.x + half);
            for (std::ptrdiff_t i = column(disc.x - half); i <= end; ++i) {
                char& cell = filled_[static_cast<std::size_t>(j * columns_ + i)];
                seen = seen || cell == 0;
                cell = 1;
            }
        }
        return seen;
    }

  private:
    std::ptrdiff_t column(double x) const {
        return std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((x - left_) / cell_), 0,
                                          columns_ - 1);
    }
    std::ptrdiff_t row(double y) const {
        return std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>((y - bottom_) / cell_), 0,
                                          rows_ - 1);
    }

    double left_, bottom_, cell_;
    std::ptrdiff_t columns_, rows_;
    std::vector<char> filled_;
};

/// Light on the face a sphere lies nearest to, less the deeper it lies in a gap of that face.
double light_of(const Vec3& depth, double largest_radius) {
    static const Vec3 face_light{0.86, 1.0, 0.95};  // right, top, front
    Eigen::Index face = 0;
    const double below = depth.minCoeff(&face);
    return face_light[face] * (1.0 - 0.5 * std::clamp(below / (1.5 * largest_radius), 0.0, 1.0));
}

}  // namespace

Camera::Camera() {
    constexpr double azimuth = 36 * std::numbers::pi / 180;    // of the eye, from z towards x
    constexpr double elevation = 24 * std::numbers::pi / 180;  // of the eye above the ground
    toward_ = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
               std::cos(elevation) * std::cos(azimuth)};
    right_ = {std::cos(azimuth), 0.0, -std::sin(azimuth)};
    up_ = toward_.cross(right_);
}

std::array<Vec3, 8> corners(const core::Box& box) {
    std::array<Vec3, 8> corner;
    for (std::size_t i = 0; i < 8; ++i) {
        corner[i] = {(i & 1) != 0 ? box.upper.x() : box.lower.x(),
                     (i & 2) != 0 ? box.upper.y() : box.lower.y(),
                     (i & 4) != 0 ? box.upper.z() : box.lower.z()};
    }
    return corner;
}

std::vector<Disc> visible_discs(const core::ParticleStore& spheres, const core::Box& box,
                                const Camera& camera) {
    if (spheres.size() == 0) return {};
    const auto [smallest, largest] = std::ranges::minmax(spheres.radius);
    struct Candidate {
        Disc disc;
        double nearness;
    };
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const Vec3 centre = spheres.position[i];
        const double r = spheres.radius[i];
        const Vec3 depth = (box.upper - centre).array() - r;  // of its nearest point, per face
        if (depth.minCoeff() > 2 * largest) continue;
        candidates.push_back(
            {{i, camera.right(centre), camera.up(centre), r, light_of(depth, largest)},
             camera.nearness(centre)});
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.nearness != b.nearness ? a.nearness > b.nearness : a.disc.sphere < b.disc.sphere;
    });

    double left = 1e300, bottom = 1e300, right = -1e300, top = -1e300;
    for (const auto& [disc, nearness] : candidates) {
        left = std::min(left, disc.x - disc.radius);
        right = std::max(right, disc.x + disc.radius);
        bottom = std::min(bottom, disc.y - disc.radius);
        top = std::max(top, disc.y + disc.radius);
    }
    const double cell = std::max(smallest / 3, std::max(right - left, top - bottom) / 4000);
    Coverage coverage(left, bottom, right - left, top - bottom, cell);
    std::vector<Disc> seen;
    for (const auto& [disc, nearness] : candidates)
        if (coverage.fill(disc)) seen.push_back(disc);
    std::ranges::reverse(seen);
    return seen;
}

}  // namespace grainfield::triaxial::report
