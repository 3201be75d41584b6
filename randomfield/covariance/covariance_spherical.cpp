#include "randomfield/covariance/covariance_spherical.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "randomfield/covariance/gauss_rule.hpp"

namespace grainfield::randomfield {
namespace {

// C at lag k is the integral of rho times the product of three hats, 1 - |v_d| around k_d. By
// symmetry the octant of positive coordinates does, cell by cell: each cell's integral of rho with
// the eight products of w and 1 - w goes to the lags at its corners. Gauss rules do it, on pieces
// where the integrand is analytic:
// - around the tip a cube with its corner there, as three pyramids (Duffy), inside which the tip's
//   root becomes a factor;
// - elsewhere boxes no longer than they are away from the tip, by halving towards it;
// - where the sphere h = 1 passes through, limits of integration on the sphere, and breaks where it
//   meets an edge. There the sections open as square roots: the pieces end with a quadratic
//   substitution, which makes them polynomials.
// All terms are positive, so that small covariances at the end of the range are good as well.

using CornerMoments = std::array<double, 8>;  // corner c: bit d set: weight w_d, else 1 - w_d

double rho(double r) {
    return (1.0 - r) * (1.0 - r) * (1.0 + 0.5 * r);
}

struct Piece {
    double low, high;
    bool on_sphere = false;  ///< ends where the sphere cuts
};

// Points of one coordinate and their weights.
struct Points {
    std::size_t size = 0;
    std::array<double, 4 * GaussRule::max_size> at{};
    std::array<double, 4 * GaussRule::max_size> weight{};

    void add(const Piece& piece, std::size_t n) {
        const GaussRule& rule = gauss_rule(n);
        const double length = piece.high - piece.low;
        for (std::size_t i = 0; i < n; ++i, ++size) {
            const double t = rule.node[i];
            // x = high - length (1 - t)^2 where it ends on the sphere.
            at[size] = piece.on_sphere ? piece.high - length * (1.0 - t) * (1.0 - t)
                                       : piece.low + length * t;
            weight[size] = rule.weight[i] * length * (piece.on_sphere ? 2.0 * (1.0 - t) : 1.0);
        }
    }
};

double root(double square) {
    return square > 0.0 ? std::sqrt(square) : 0.0;
}

// One coordinate's points over [low, high] as far as the section reaches, with breaks at `breaks`.
template <std::size_t m>
Points points_between(double low, double high, double end, std::array<double, m> breaks,
                      std::size_t n) {
    Points points;
    const bool cut = end < high;
    const double last = cut ? end : high;
    std::sort(breaks.begin(), breaks.end());
    double from = low;
    for (const double at : breaks) {
        if (at <= from || at >= last) continue;
        points.add({from, at, true}, n);
        from = at;
    }
    if (last > from) points.add({from, last, cut}, n);
    return points;
}

constexpr std::size_t kCutPoints = 16;

// Enough points for 1e-15 where the tip is 1/ratio lengths away.
std::size_t points_for(double ratio) {
    return ratio > 0.5 ? 13 : ratio > 0.25 ? 9 : ratio > 0.125 ? 7 : 5;
}

class Cell {
  public:
    Cell(const Vec3& edge, const std::array<std::int32_t, 3>& index) : edge_(edge) {
        for (std::size_t d = 0; d < 3; ++d) {
            first_[d] = index[d] * edge[static_cast<int>(d)];
            last_[d] = (index[d] + 1) * edge[static_cast<int>(d)];
        }
    }

    // The cell's pieces in direction d: halved towards the tip in the first cell, cut at the range.
    [[nodiscard]] std::vector<Piece> pieces(std::size_t d, double tip) const {
        const double end = std::min(last_[d], 1.0);
        if (first_[d] > 0.0) return {{first_[d], end}};
        std::vector<Piece> all{{0.0, tip}};
        while (all.back().high < end) {
            const double from = all.back().high;
            all.push_back({from, 2.0 * from < 0.99 * end ? 2.0 * from : end});
        }
        return all;
    }

    // The cube [0, tip]^3, entirely inside the sphere.
    void add_tip(double tip, CornerMoments& m) const {
        const GaussRule& radial = gauss_rule(6);
        const GaussRule& across = gauss_rule(16);
        for (std::size_t i = 0; i < radial.size; ++i) {
            const double a = tip * radial.node[i];
            for (std::size_t p = 0; p < across.size; ++p) {
                const double b = a * across.node[p];
                for (std::size_t q = 0; q < across.size; ++q) {
                    const double c = a * across.node[q];
                    const double f = tip * radial.weight[i] * across.weight[p] * across.weight[q] *
                                     a * a * rho(std::sqrt(a * a + b * b + c * c));
                    add_point({a, b, c}, f, m);
                    add_point({b, a, c}, f, m);
                    add_point({b, c, a}, f, m);
                }
            }
        }
    }

    void add_box(const Piece& x, const Piece& y, const Piece& z, CornerMoments& m) const {
        const double nearest = std::hypot(x.low, y.low, z.low);
        if (nearest >= 1.0) return;
        const bool cut = std::hypot(x.high, y.high, z.high) > 1.0;
        const auto count = [&](const Piece& side) {
            return cut ? kCutPoints : points_for((side.high - side.low) / nearest);
        };
        const auto square = [](double a) { return a * a; };
        // Where the edges of the box in x leave the sphere: there sections change their shape.
        const Points px = points_between<3>(
            x.low, x.high, root(1.0 - square(y.low) - square(z.low)),
            {root(1.0 - square(y.high) - square(z.low)), root(1.0 - square(y.low) - square(z.high)),
             root(1.0 - square(y.high) - square(z.high))},
            count(x));
        for (std::size_t i = 0; i < px.size; ++i) {
            const double xx = square(px.at[i]);
            const Points py = points_between<1>(y.low, y.high, root(1.0 - xx - square(z.low)),
                                                {root(1.0 - xx - square(z.high))}, count(y));
            for (std::size_t j = 0; j < py.size; ++j) {
                const double xy = xx + square(py.at[j]);
                const double end = root(1.0 - xy);
                if (end <= z.low) continue;
                const Points pz = points_between<0>(z.low, z.high, end, {}, count(z));
                double low = 0.0, high = 0.0;
                for (std::size_t k = 0; k < pz.size; ++k) {
                    const double f =
                        pz.weight[k] * rho(std::min(1.0, std::sqrt(xy + square(pz.at[k]))));
                    const double w = fraction(2, pz.at[k]);
                    low += (1.0 - w) * f;
                    high += w * f;
                }
                const double wx = fraction(0, px.at[i]), wy = fraction(1, py.at[j]);
                const double f = px.weight[i] * py.weight[j];
                for (std::size_t c = 0; c < 8; ++c) {
                    m[c] += f * (c & 1 ? wx : 1.0 - wx) * (c & 2 ? wy : 1.0 - wy) *
                            (c & 4 ? high : low);
                }
            }
        }
    }

    [[nodiscard]] bool out_of_range() const {
        return std::hypot(first_[0], first_[1], first_[2]) >= 1.0;
    }

  private:
    [[nodiscard]] double fraction(std::size_t d, double at) const {
        return (at - first_[d]) / edge_[static_cast<int>(d)];
    }
    void add_point(const std::array<double, 3>& at, double f, CornerMoments& m) const {
        const double wx = fraction(0, at[0]), wy = fraction(1, at[1]), wz = fraction(2, at[2]);
        for (std::size_t c = 0; c < 8; ++c) {
            m[c] += f * (c & 1 ? wx : 1.0 - wx) * (c & 2 ? wy : 1.0 - wy) * (c & 4 ? wz : 1.0 - wz);
        }
    }

    Vec3 edge_;
    std::array<double, 3> first_{}, last_{};
};

CornerMoments corner_moments(const Vec3& edge, const std::array<std::int32_t, 3>& index,
                             double tip) {
    const Cell cell(edge, index);
    CornerMoments m{};
    if (cell.out_of_range()) return m;
    for (const Piece& x : cell.pieces(0, tip)) {
        for (const Piece& y : cell.pieces(1, tip)) {
            for (const Piece& z : cell.pieces(2, tip)) {
                if (x.low == 0.0 && y.low == 0.0 && z.low == 0.0) {
                    cell.add_tip(tip, m);
                } else {
                    cell.add_box(x, y, z, m);
                }
            }
        }
    }
    return m;
}

}  // namespace

void spherical_cell_averages(const Vec3& edge, const std::array<std::int32_t, 3>& lags,
                             std::span<double> table) {
    std::fill(table.begin(), table.end(), 0.0);
    const double tip = std::min(0.5, edge.minCoeff());  // its cube lies inside the sphere
    for (std::int32_t k = 0; k < lags[2]; ++k) {
        for (std::int32_t j = 0; j < lags[1]; ++j) {
            for (std::int32_t i = 0; i < lags[0]; ++i) {
                const CornerMoments m = corner_moments(edge, {i, j, k}, tip);
                for (std::size_t c = 0; c < 8; ++c) {
                    const std::array<std::int32_t, 3> node{i + (c & 1 ? 1 : 0), j + (c & 2 ? 1 : 0),
                                                           k + (c & 4 ? 1 : 0)};
                    if (node[0] >= lags[0] || node[1] >= lags[1] || node[2] >= lags[2]) continue;
                    const auto row = static_cast<std::size_t>(node[2]) * lags[1] + node[1];
                    double part = m[c];
                    for (std::size_t d = 0; d < 3; ++d) {
                        // At lag 0 the hat's other half gives the same.
                        part *= (node[d] == 0 ? 2.0 : 1.0) / edge[static_cast<int>(d)];
                    }
                    table[row * lags[0] + node[0]] += part;
                }
            }
        }
    }
}

}  // namespace grainfield::randomfield
