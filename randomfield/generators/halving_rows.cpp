#include "randomfield/generators/halving_rows.hpp"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "randomfield/generators/halving_rows.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grainfield::randomfield::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, row_group>;
using V = hn::Vec<D>;
constexpr D d;
constexpr std::size_t kLanes = HWY_LANES(double) < row_group ? HWY_LANES(double) : row_group;

// Zeros in front of, between and behind the cells of a row.
HWY_INLINE void clear_ends(const RowLayout& layout, double* row) {
    for (std::size_t t = 0; t < row_group; t += kLanes) {
        hn::Store(hn::Zero(d), d, row + t);
        hn::Store(hn::Zero(d), d, row + layout.odd_at - row_group + t);
        hn::Store(hn::Zero(d), d, row + layout.size - row_group + t);
    }
}

// `width` vectors at `at` of the piece, in each of `count` rows: four sums or so at once, since
// each waits for itself at every term. Add and Mul apart, never MulAdd: plain code, which has no
// fused one, must get the same bits.
template <bool alike, std::size_t count, std::size_t width>
HWY_INLINE void draw(const RowPiece& piece, std::size_t at, const RowsToDraw& rows) {
    V sum[count * width];
    const double* weight = piece.weights;
    const auto weight_of = [&](std::size_t v) HWY_ATTR {
        return alike ? hn::Set(d, *weight) : hn::Load(d, weight + at + v * kLanes);
    };
    const double* normals = rows.normals + piece.first_normal + at;
    for (std::size_t v = 0; v < width; ++v) {
        const V w = weight_of(v);
        for (std::size_t r = 0; r < count; ++r) {
            const double* from = normals + r * rows.normals_apart + v * kLanes;
            if constexpr (alike) {
                sum[r * width + v] = hn::Mul(w, hn::LoadU(d, from));
            } else {
                const std::size_t done = at + v * kLanes;
                const std::size_t left = piece.cells > done ? piece.cells - done : 0;
                // With nothing left not even one may be read: plain code has no masked loads.
                sum[r * width + v] =
                    left == 0 ? hn::Zero(d)
                              : hn::Mul(w, hn::MaskedLoad(hn::FirstN(d, std::min(left, kLanes)), d,
                                                          from));
            }
        }
    }
    const auto add = [&](const double* base, std::span<const std::ptrdiff_t> terms) HWY_ATTR {
        for (const std::ptrdiff_t term : terms) {
            weight += alike ? 1 : row_group;
            const double* from = base + term + at;
            for (std::size_t v = 0; v < width; ++v) {
                const V w = weight_of(v);
                for (std::size_t r = 0; r < count; ++r) {
                    V& s = sum[r * width + v];
                    s = hn::Add(s, hn::Mul(w, hn::LoadU(d, from + r * rows.apart + v * kLanes)));
                }
            }
        }
    };
    add(rows.parents, piece.parents);
    add(rows.details, piece.details);
    for (std::size_t r = 0; r < count; ++r) {
        for (std::size_t v = 0; v < width; ++v) {
            const V e = sum[r * width + v];
            const std::size_t to = piece.at + at + v * kLanes;
            hn::Store(e, d, rows.details + r * rows.apart + to);
            if (rows.front == nullptr) continue;
            const V p = hn::Load(d, rows.parents + r * rows.apart + to);
            const std::size_t child = r * rows.children_apart + to;
            hn::Store(hn::Add(p, e), d, rows.front + child);
            if (rows.behind != nullptr) hn::Store(hn::Sub(p, e), d, rows.behind + child);
        }
    }
}

template <std::size_t count>
void draw_together(std::span<const RowPiece> pieces, const RowsToDraw& rows) {
    constexpr std::size_t width = 4 / count;
    const RowLayout layout(rows.n);
    for (std::size_t r = 0; r < count; ++r) {
        clear_ends(layout, rows.details + r * rows.apart);
        if (rows.front != nullptr) clear_ends(layout, rows.front + r * rows.children_apart);
        if (rows.behind != nullptr) clear_ends(layout, rows.behind + r * rows.children_apart);
    }
    for (const RowPiece& piece : pieces) {
        const std::size_t numbers = piece.groups * row_group;
        std::size_t at = 0;
        if (!piece.alike) {
            for (; at < numbers; at += kLanes) draw<false, count, 1>(piece, at, rows);
            continue;
        }
        for (; at + width * kLanes <= numbers; at += width * kLanes) {
            draw<true, count, width>(piece, at, rows);
        }
        for (; at < numbers; at += kLanes) draw<true, count, 1>(piece, at, rows);
    }
}

void draw_rows(std::span<const RowPiece> pieces, const RowsToDraw& rows) {
    switch (rows.count) {
        case 4:
            return draw_together<4>(pieces, rows);
        case 2:
            return draw_together<2>(pieces, rows);
        default:
            return draw_together<1>(pieces, rows);
    }
}

// Cell i's halves are cells 2 i and 2 i + 1: the i-th of the even and of the odd ones.
void halve_along_row(std::size_t n, std::size_t halves, const double* parents,
                     const double* details, double* children) {
    const RowLayout layout(n), of_children(halves);
    const auto first = [&](std::size_t at) { return parents[at] + details[at]; };
    const auto second = [&](std::size_t at) { return parents[at] - details[at]; };
    clear_ends(of_children, children);
    double *even = children + RowLayout::even_at, *odd = children + of_children.odd_at;
    std::fill_n(even + of_children.even, RowLayout::filled(of_children.even) - of_children.even,
                0.0);
    std::fill_n(odd + of_children.odd, RowLayout::filled(of_children.odd) - of_children.odd, 0.0);
    std::size_t t = 0;
    for (; t + kLanes <= layout.odd && 2 * (t + kLanes) <= of_children.odd; t += kLanes) {
        const std::size_t a = RowLayout::even_at + t, b = layout.odd_at + t;
        const V pa = hn::Load(d, parents + a), pb = hn::Load(d, parents + b);
        const V ea = hn::Load(d, details + a), eb = hn::Load(d, details + b);
        hn::StoreInterleaved2(hn::Add(pa, ea), hn::Add(pb, eb), d, even + 2 * t);
        hn::StoreInterleaved2(hn::Sub(pa, ea), hn::Sub(pb, eb), d, odd + 2 * t);
    }
    for (std::size_t i = 2 * t; i < n; ++i) {
        even[i] = first(layout.place(i));
        if (i < of_children.odd) odd[i] = second(layout.place(i));
    }
}

void row_in_order(std::size_t n, const double* row, double* in_order) {
    const RowLayout layout(n);
    const double *even = row + RowLayout::even_at, *odd = row + layout.odd_at;
    std::size_t t = 0;
    for (; t + kLanes <= layout.odd; t += kLanes) {
        hn::StoreInterleaved2(hn::Load(d, even + t), hn::Load(d, odd + t), d, in_order + 2 * t);
    }
    for (; t < layout.odd; ++t) {
        in_order[2 * t] = even[t];
        in_order[2 * t + 1] = odd[t];
    }
    if (n % 2 == 1) in_order[n - 1] = even[t];
}

// Transposes kLanes x kLanes numbers.
HWY_INLINE void transpose([[maybe_unused]] V (&x)[kLanes]) {
#if HWY_TARGET != HWY_SCALAR
    V pair[kLanes];
    // Columns 2 b and 2 b + 1 of two rows: in block b.
    for (std::size_t r = 0; r < kLanes; r += 2) {
        pair[r] = hn::InterleaveLower(d, x[r], x[r + 1]);
        pair[r + 1] = hn::InterleaveUpper(d, x[r], x[r + 1]);
    }
    if constexpr (kLanes == 2) {
        for (std::size_t r = 0; r < kLanes; ++r) x[r] = pair[r];
    } else if constexpr (kLanes == 4) {
        for (std::size_t odd = 0; odd < 2; ++odd) {
            x[odd] = hn::ConcatLowerLower(d, pair[2 + odd], pair[odd]);
            x[2 + odd] = hn::ConcatUpperUpper(d, pair[2 + odd], pair[odd]);
        }
    } else {
        alignas(64) static constexpr std::int64_t middle_swapped[8] = {0, 1, 4, 5, 2, 3, 6, 7};
        const auto swap = hn::SetTableIndices(d, middle_swapped);
        for (std::size_t odd = 0; odd < 2; ++odd) {
            for (std::size_t half = 0; half < 2; ++half) {
                // Blocks 2 half and 2 half + 1 of four pairs of rows: a0 a1 b0 b1, c0 c1 e0 e1.
                const V a = pair[odd], b = pair[2 + odd], c = pair[4 + odd], e = pair[6 + odd];
                V ab = half == 0 ? hn::ConcatLowerLower(d, b, a) : hn::ConcatUpperUpper(d, b, a);
                V ce = half == 0 ? hn::ConcatLowerLower(d, e, c) : hn::ConcatUpperUpper(d, e, c);
                ab = hn::TableLookupLanes(ab, swap);
                ce = hn::TableLookupLanes(ce, swap);
                x[4 * half + odd] = hn::ConcatLowerLower(d, ce, ab);
                x[4 * half + 2 + odd] = hn::ConcatUpperUpper(d, ce, ab);
            }
        }
    }
#endif
}

void rows_to_columns(std::size_t n, std::size_t rows, std::size_t apart, const double* row,
                     std::size_t stride, double* table) {
    const RowLayout layout(n);
    for (std::size_t parity = 0; parity < 2; ++parity) {
        const std::size_t begin = parity == 0 ? RowLayout::even_at : layout.odd_at;
        const std::size_t cells = parity == 0 ? layout.even : layout.odd;
        for (std::size_t t = 0; t < cells; t += kLanes) {
            const std::size_t columns = std::min(kLanes, cells - t);
            for (std::size_t r = 0; r < rows; r += kLanes) {
                const std::size_t there = std::min(kLanes, rows - r);
                V x[kLanes];
                for (std::size_t v = 0; v < kLanes; ++v) {
                    x[v] = v < there ? hn::Load(d, row + (r + v) * apart + begin + t) : hn::Zero(d);
                }
                transpose(x);
                double* to = table + (2 * t + parity) * stride + r;
                for (std::size_t v = 0; v < columns; ++v) {
                    if (there == kLanes) {
                        hn::StoreU(x[v], d, to + 2 * v * stride);
                    } else {
                        hn::BlendedStore(x[v], hn::FirstN(d, there), d, to + 2 * v * stride);
                    }
                }
            }
        }
    }
}

}  // namespace grainfield::randomfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainfield::randomfield {

HWY_EXPORT(draw_rows);
HWY_EXPORT(halve_along_row);
HWY_EXPORT(row_in_order);
HWY_EXPORT(rows_to_columns);

void draw_rows(std::span<const RowPiece> pieces, const RowsToDraw& rows) {
    HWY_DYNAMIC_DISPATCH(draw_rows)(pieces, rows);
}

void halve_along_row(std::size_t n, std::size_t halves, const double* parents,
                     const double* details, double* children) {
    HWY_DYNAMIC_DISPATCH(halve_along_row)(n, halves, parents, details, children);
}

void row_in_order(std::size_t n, const double* row, double* in_order) {
    HWY_DYNAMIC_DISPATCH(row_in_order)(n, row, in_order);
}

void rows_to_columns(std::size_t n, std::size_t rows, std::size_t apart, const double* row,
                     std::size_t stride, double* table) {
    HWY_DYNAMIC_DISPATCH(rows_to_columns)(n, rows, apart, row, stride, table);
}

}  // namespace grainfield::randomfield
#endif
