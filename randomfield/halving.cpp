#include "randomfield/halving.hpp"

#include <algorithm>

namespace grainfield::randomfield {
namespace {

// Below this, starting threads takes longer than the work.
constexpr std::size_t kParallelCells = 16384;

// The numbers 0 ... n - 1 whose surroundings differ, first occurrences.
std::vector<std::int32_t> kinds_of_places(std::int32_t n) {
    std::vector<std::int32_t> places;
    std::array<bool, Surroundings::kinds> seen{};
    for (std::int32_t i = 0; i < n; ++i) {
        bool& known = seen[surroundings_of(i, n).id()];
        if (!known) places.push_back(i);
        known = true;
    }
    return places;
}

std::size_t row_id(const Surroundings& along1, const Surroundings& along2) {
    return along1.id() * Surroundings::kinds + along2.id();
}

}  // namespace

Halving::Halving(const GridSpec& parents, const CellCount& children, std::size_t axis,
                 const CorrelationModel& correlation)
    : parents_(parents.cells),
      children_(children),
      axis_(axis),
      row_kind_(Surroundings::kinds * Surroundings::kinds, 0) {
    const std::int32_t n0 = parents_[0], n1 = parents_[1], n2 = parents_[2];
    for (const bool odd : {false, true}) {
        for (const std::int32_t first : kinds_of_places(n0)) {
            const Surroundings around = surroundings_of(first, n0);
            if (around.odd != odd) continue;
            Segment segment{first, 0, around};
            for (std::int32_t i = first; i < n0 && surroundings_of(i, n0).id() == around.id();
                 i += 2) {
                ++segment.count;
            }
            segments_.push_back(segment);
        }
    }
    const DetailCovariance covariance(parents.cell_size, parents_, axis, correlation);
    struct RowKind {
        Surroundings along1, along2;
    };
    std::vector<RowKind> kinds;
    for (const std::int32_t j : kinds_of_places(n1)) {
        for (const std::int32_t k : kinds_of_places(n2)) {
            kinds.push_back({surroundings_of(j, n1), surroundings_of(k, n2)});
            row_kind_[row_id(kinds.back().along1, kinds.back().along2)] = kinds.size() - 1;
        }
    }
    const auto placed = [&, nn0 = n0, nn1 = n1](const std::vector<DetailTerm>& terms,
                                                std::int32_t first) {
        std::vector<kernels::RowTerm> all;
        all.reserve(terms.size());
        for (const DetailTerm& t : terms) {
            const std::ptrdiff_t row = t.offset[1] + std::ptrdiff_t{t.offset[2]} * nn1;
            all.push_back({row * nn0 + place_in_row(first + t.offset[0], nn0), t.weight});
        }
        return all;
    };
    for (const RowKind& kind : kinds) {
        std::vector<Weights> row;
        for (const Segment& segment : segments_) {
            const DetailStencil stencil =
                covariance.stencil({segment.around, kind.along1, kind.along2});
            row.push_back({placed(stencil.cells, segment.first),
                           placed(stencil.details, segment.first), stencil.noise});
        }
        weights_.push_back(std::move(row));
    }
}

void Halving::draw_row(std::int32_t j, std::int32_t k, const double* normals, const double* parents,
                       double* details) const {
    const std::int32_t n0 = parents_[0], n1 = parents_[1], n2 = parents_[2];
    const std::size_t kind = row_kind_[row_id(surroundings_of(j, n1), surroundings_of(k, n2))];
    const std::size_t row = (static_cast<std::size_t>(k) * n1 + j) * n0;
    for (std::size_t s = 0; s < segments_.size(); ++s) {
        const Segment& segment = segments_[s];
        const Weights& w = weights_[kind][s];
        const std::size_t at = row + static_cast<std::size_t>(place_in_row(segment.first, n0));
        // A row's own details are written and read here, but never the same parity.
        kernels::sum_rows(segment.count, w.noise, normals + at, parents + row, w.cells,
                          details + row, w.details, details + at);
    }
}

void Halving::draw_details(std::span<const double> normals, std::span<const double> parents,
                           std::span<double> details) const {
    const std::int32_t n1 = parents_[1], n2 = parents_[2];
#pragma omp parallel if (size() >= kParallelCells)
    for (std::int32_t parity = 0; parity < 4; ++parity) {
        const std::int32_t j0 = parity % 2, k0 = parity / 2;
        const std::int32_t rows1 = (n1 - j0 + 1) / 2, rows2 = (n2 - k0 + 1) / 2;
        // The rows of one parity read those of earlier ones, and write none that others read.
#pragma omp for schedule(static)
        for (std::int32_t r = 0; r < rows1 * rows2; ++r) {
            draw_row(j0 + 2 * (r % rows1), k0 + 2 * (r / rows1), normals.data(), parents.data(),
                     details.data());
        }
    }
}

void Halving::make_children(std::span<const double> parents, std::span<const double> details,
                            std::span<double> children) const {
    const std::int32_t n0 = parents_[0], n1 = parents_[1], n2 = parents_[2];
    const std::int32_t c0 = children_[0], c1 = children_[1];
    const std::int32_t rows = n1 * n2;
    const std::size_t axis = axis_;
#pragma omp parallel for schedule(static) if (size() >= kParallelCells)
    for (std::int32_t r = 0; r < rows; ++r) {
        const double* p = parents.data() + static_cast<std::size_t>(r) * n0;
        const double* e = details.data() + static_cast<std::size_t>(r) * n0;
        const std::int32_t j = r % n1, k = r / n1;
        const auto row = [&, cc0 = c0, cc1 = c1](std::int32_t jj, std::int32_t kk) {
            return children.data() + (static_cast<std::size_t>(kk) * cc1 + jj) * cc0;
        };
        if (axis == 0) {
            // Cell i's halves are cells 2 i and 2 i + 1: entry i of the even and of the odd ones.
            double* even = row(j, k);
            double* odd = even + n0;
            const std::int32_t half = (n0 + 1) / 2;
            for (std::int32_t t = 0; t < n0 / 2; ++t) {
                even[2 * t] = p[t] + e[t];
                even[2 * t + 1] = p[half + t] + e[half + t];
            }
            if (n0 % 2 == 1) even[n0 - 1] = p[half - 1] + e[half - 1];
            for (std::int32_t i = 0; i < c0 / 2; ++i) {
                const std::int32_t at = place_in_row(i, n0);
                odd[i] = p[at] - e[at];
            }
            continue;
        }
        const std::int32_t step1 = axis == 1 ? 2 : 1, step2 = axis == 2 ? 2 : 1;
        double* front = row(step1 * j, step2 * k);
        for (std::int32_t t = 0; t < n0; ++t) front[t] = p[t] + e[t];
        const std::int32_t jj = axis == 1 ? 2 * j + 1 : j, kk = axis == 2 ? 2 * k + 1 : k;
        if (jj >= c1 || kk >= children_[2]) continue;
        double* back = row(jj, kk);
        for (std::int32_t t = 0; t < n0; ++t) back[t] = p[t] - e[t];
    }
}

}  // namespace grainfield::randomfield
