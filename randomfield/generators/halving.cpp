#include "randomfield/generators/halving.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

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

// A term of any cell of a piece: weights of its numbers, where they have it.
struct Term {
    CellCount offset;
    std::array<double, row_group> weights{};
};

using Key = std::array<std::int32_t, 3>;

// The orders in which stencils have their cells and their details, which sums must keep.
Key order_of_cell(const CellCount& o) {
    return {o[2], o[1], o[0]};
}
Key order_of_detail(const CellCount& o) {
    return {std::abs(o[2]), std::abs(o[1]), o[0] + o[1] + o[2]};
}

void add_term(std::vector<Term>& terms, Key (*order)(const CellCount&), const DetailTerm& term,
              std::size_t lane) {
    auto at = std::find_if(terms.begin(), terms.end(), [&](const Term& known) {
        return order(known.offset) >= order(term.offset);
    });
    if (at == terms.end() || at->offset != term.offset)
        at = terms.insert(at, Term{term.offset, {}});
    at->weights[lane] = term.weight;
}

}  // namespace

Halving::Halving(const GridSpec& parents, const CellCount& children, std::size_t axis,
                 const CorrelationModel& correlation)
    : parents_(parents.cells),
      children_(children),
      axis_(axis),
      slab_axis_(parents.cells[2] >= parents.cells[1] ? 2 : 1) {
    const DetailCovariance covariance(parents.cell_size, parents_, axis, correlation);
    std::vector<Surroundings> kinds[2];
    for (const std::size_t d : {0u, 1u}) {
        const std::int32_t n = parents_[d + 1];
        for (const std::int32_t i : kinds_of_places(n)) kinds[d].push_back(surroundings_of(i, n));
        for (std::int32_t i = 0; i < n; ++i) {
            const std::size_t id = surroundings_of(i, n).id();
            const auto known = std::find_if(kinds[d].begin(), kinds[d].end(),
                                            [&](const Surroundings& s) { return s.id() == id; });
            row_kinds_[d].push_back(static_cast<std::size_t>(known - kinds[d].begin()));
        }
    }
    kinds_along2_ = kinds[1].size();
    for (const Surroundings& along1 : kinds[0]) {
        for (const Surroundings& along2 : kinds[1]) {
            kinds_.push_back(make_kind(covariance, along1, along2));
        }
    }
}

Halving::RowKind Halving::make_kind(const DetailCovariance& covariance, const Surroundings& along1,
                                    const Surroundings& along2) const {
    const RowGrid grid(parents_);
    const std::int32_t n = parents_[0];
    std::array<std::optional<DetailStencil>, Surroundings::kinds> stencils;
    const auto stencil_of = [&](std::int32_t i) -> const DetailStencil& {
        const Surroundings along0 = surroundings_of(i, n);
        std::optional<DetailStencil>& stencil = stencils[along0.id()];
        if (!stencil) stencil = covariance.stencil({along0, along1, along2});
        return *stencil;
    };
    RowKind kind;
    // Cells from `first` on, every second of them: groups that are all alike, or one group.
    const auto add = [&](std::int32_t first, std::size_t cells, bool alike) {
        RowPiece piece;
        piece.at = grid.row.place(static_cast<std::size_t>(first));
        piece.groups = RowLayout::filled(cells) / row_group;
        piece.cells = cells;
        piece.alike = alike;
        piece.first_normal =
            static_cast<std::size_t>(first / 2) + (first % 2 == 0 ? 0 : grid.row.even);
        const std::size_t lanes = alike ? 1 : cells;
        const std::size_t stride = alike ? 1 : row_group;
        std::vector<Term> of_cells, of_details;
        core::Aligned<double> weights(stride, 0.0);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const DetailStencil& stencil = stencil_of(first + 2 * static_cast<std::int32_t>(lane));
            weights[lane] = stencil.noise;
            for (const DetailTerm& term : stencil.cells)
                add_term(of_cells, order_of_cell, term, lane);
            for (const DetailTerm& term : stencil.details)
                add_term(of_details, order_of_detail, term, lane);
        }
        const auto place = [&](const std::vector<Term>& terms) {
            std::vector<std::ptrdiff_t> places;
            for (const Term& term : terms) {
                const std::ptrdiff_t row =
                    term.offset[1] + std::ptrdiff_t{term.offset[2]} * parents_[1];
                // A cell of even index has those of odd index before it at its own place less one.
                const std::int32_t i = first + term.offset[0];
                const bool odd = i % 2 != 0;
                const std::ptrdiff_t in_row =
                    static_cast<std::ptrdiff_t>(odd ? grid.row.odd_at : grid.row.even_at) +
                    (i - (odd ? 1 : 0)) / 2;
                places.push_back(row * static_cast<std::ptrdiff_t>(grid.row.size) + in_row);
                weights.insert(weights.end(), term.weights.begin(),
                               term.weights.begin() + static_cast<std::ptrdiff_t>(stride));
            }
            return places;
        };
        kind.places.push_back(place(of_cells));
        piece.parents = kind.places.back();
        kind.places.push_back(place(of_details));
        piece.details = kind.places.back();
        kind.weights.push_back(std::move(weights));
        piece.weights = kind.weights.back().data();
        kind.pieces.push_back(piece);
    };
    for (const std::int32_t parity : {0, 1}) {
        const auto cells = static_cast<std::size_t>((n + 1 - parity) / 2);
        const auto alike = [&](std::size_t group) {
            const std::size_t end = (group + 1) * row_group;
            if (end > cells) return false;
            const auto cell = [&](std::size_t t) {
                return surroundings_of(2 * static_cast<std::int32_t>(t) + parity, n).id();
            };
            for (std::size_t t = end - row_group; t < end; ++t) {
                if (cell(t) != cell(cells / 2)) return false;
            }
            return true;
        };
        const std::size_t groups = RowLayout::filled(cells) / row_group;
        for (std::size_t g = 0; g < groups;) {
            const std::size_t from = g;
            while (g < groups && alike(g)) ++g;
            const bool same = g > from;
            if (!same) ++g;
            const std::size_t t = from * row_group;
            add(2 * static_cast<std::int32_t>(t) + parity, std::min(cells, g * row_group) - t,
                same);
        }
    }
    return kind;
}

void Halving::make_rows(std::int32_t j, std::int32_t k, std::int32_t count, const double* normals,
                        const double* parents, double* details, double* children) const {
    const RowGrid grid(parents_), halves(children_);
    const std::size_t at = grid.at(j, k), n = static_cast<std::size_t>(parents_[0]);
    const bool along1 = slab_axis_ == 2;  // the next row is two further along axis 1, or axis 2
    const std::size_t apart = grid.at(along1 ? 2 : 0, along1 ? 0 : 2);
    RowsToDraw rows;
    rows.n = n;
    rows.count = static_cast<std::size_t>(count);
    rows.normals = normals + static_cast<std::size_t>(along1 ? j : k) * n;
    rows.normals_apart = 2 * n;
    rows.parents = parents + at;
    rows.details = details + at;
    rows.apart = apart;
    const RowKind& kind = kinds_[kind_of(j, k)];
    if (axis_ == 0) {
        draw_rows(kind.pieces, rows);
        for (std::int32_t r = 0; r < count; ++r) {
            const std::size_t row = static_cast<std::size_t>(r) * apart;
            halve_along_row(n, static_cast<std::size_t>(children_[0]), rows.parents + row,
                            rows.details + row,
                            children + halves.at(along1 ? j + 2 * r : j, along1 ? k : k + 2 * r));
        }
        return;
    }
    const std::int32_t step1 = axis_ == 1 ? 2 : 1, step2 = axis_ == 2 ? 2 : 1;
    rows.children_apart = halves.at(along1 ? 2 * step1 : 0, along1 ? 0 : 2 * step2);
    rows.front = children + halves.at(step1 * j, step2 * k);
    // The last parent of an odd number of children has one only; its kind is that of no other.
    const std::int32_t jj = step1 * j + step1 - 1, kk = step2 * k + step2 - 1;
    if (jj < children_[1] && kk < children_[2]) rows.behind = children + halves.at(jj, kk);
    draw_rows(kind.pieces, rows);
}

// All rows of one place along the slabs' axis, in the order that detail_stencil.hpp asks for.
void Halving::make_slab(std::int32_t slab, const double* normals, const double* parents,
                        double* details, double* children) const {
    const std::int32_t rows = parents_[3 - slab_axis_];
    const auto j = [&](std::int32_t r) { return slab_axis_ == 2 ? r : slab; };
    const auto k = [&](std::int32_t r) { return slab_axis_ == 2 ? slab : r; };
    for (const std::int32_t parity : {0, 1}) {
        for (std::int32_t r = parity; r < rows;) {
            std::int32_t alike = 1;
            while (alike < 4 && r + 2 * alike < rows &&
                   kind_of(j(r + 2 * alike), k(r + 2 * alike)) == kind_of(j(r), k(r))) {
                ++alike;
            }
            if (alike == 3) alike = 2;
            make_rows(j(r), k(r), alike, normals, parents, details, children);
            r += 2 * alike;
        }
    }
}

// In a row's order, one row of the slab after the other.
const double* Halving::normals_of_slab(std::int32_t slab, const NormalSource& normals,
                                       std::size_t first) const {
    const auto n = static_cast<std::size_t>(parents_[0]);
    const auto rows = static_cast<std::size_t>(parents_[3 - slab_axis_]);
    const auto at = static_cast<std::size_t>(slab);
    thread_local std::vector<double> room;
    if (room.size() < rows * n) room.resize(rows * n);
    const std::span<double> all = std::span<double>(room).first(rows * n);
    if (slab_axis_ == 2) return normals.get(first + at * rows * n, all);
    const auto slabs = static_cast<std::size_t>(parents_[1]);
    for (std::size_t k = 0; k < rows; ++k) {
        const std::span<double> row = all.subspan(k * n, n);
        const double* of_row = normals.get(first + (k * slabs + at) * n, row);
        if (of_row == row.data()) continue;
        for (std::size_t i = 0; i < n; ++i) row[i] = of_row[i];
    }
    return room.data();
}

void Halving::make_children(const NormalSource& normals, std::size_t first_normal,
                            std::span<const double> parents, std::span<double> details,
                            std::span<double> children) const {
    const std::int32_t slabs = parents_[slab_axis_];
    const std::int32_t even = (slabs + 1) / 2;
    const auto make = [&](std::int32_t slab) {
        make_slab(slab, normals_of_slab(slab, normals, first_normal), parents.data(),
                  details.data(), children.data());
    };
#pragma omp parallel if (size() >= kParallelCells)
    {
        // Of each thread some slabs of even index and the odd ones behind them. An odd one reads
        // the details of both its neighbours; the next thread draws its first slab before all.
        const std::int32_t threads = omp_get_num_threads(), thread = omp_get_thread_num();
        const std::int32_t first = even * thread / threads, end = even * (thread + 1) / threads;
        if (first < end) make(2 * first);
#pragma omp barrier
        for (std::int32_t e = first; e < end; ++e) {
            if (e + 1 < end) make(2 * e + 2);
            if (2 * e + 1 < slabs) make(2 * e + 1);
        }
    }
}

}  // namespace grainfield::randomfield
