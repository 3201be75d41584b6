// Rows of local average subdivision: the same bits as plain loops, whatever vectors this machine
// has.

#include "randomfield/generators/halving_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/aligned.hpp"

namespace grainfield::randomfield {
namespace {

using Numbers = core::Aligned<double>;

Numbers some_numbers(std::size_t count, double phase) {
    Numbers x(count);
    for (std::size_t i = 0; i < count; ++i) x[i] = std::sin(phase + 1.7 * static_cast<double>(i));
    return x;
}

// Every cell and every zero of a row has a place of its own.
TEST(HalvingRows, LayoutHasEveryCellOnceAndZerosAround) {
    for (std::size_t n = 1; n < 70; ++n) {
        const RowLayout layout(n);
        std::vector<int> taken(layout.size, 0);
        for (std::size_t i = 0; i < n; ++i) ++taken.at(layout.place(i));
        EXPECT_EQ(layout.size % row_group, 0u);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(taken[layout.place(i)], 1) << n;
            for (const std::size_t next : {layout.place(i) - 1, layout.place(i) + 1}) {
                ASSERT_LT(next, layout.size);
            }
        }
        EXPECT_EQ(taken[RowLayout::even_at - 1] + taken[RowLayout::even_at + layout.even] +
                      taken[layout.odd_at - 1] + taken[layout.odd_at + layout.odd],
                  0)
            << n;
    }
}

// No tolerance: products and sums are rounded apart, in the same order. A piece that is alike, one
// with a weight for each number, in one row, two and four, with both children, one and none.
TEST(HalvingRows, DetailsAndChildrenAreThePlainSumsToTheLastBit) {
    constexpr std::size_t n = 90;  // 45 of even index: five groups that are alike, one of 5
    const RowLayout layout(n);
    const std::size_t apart = 2 * layout.size, children_apart = 3 * layout.size;
    const Numbers normals = some_numbers(n * 8, 0.4), parents = some_numbers(9 * layout.size, 0.1);
    const auto size = static_cast<std::ptrdiff_t>(layout.size);
    const std::ptrdiff_t of_alike[] = {8, 9 + size, 7}, of_last[] = {48, 49 + size};
    const std::ptrdiff_t of_details[] = {static_cast<std::ptrdiff_t>(layout.odd_at)};
    const Numbers alike{0.9, 0.3, -1.1, 0.01, 2.0};
    Numbers each = some_numbers(4 * row_group, 0.3);
    const RowPiece pieces[] = {{layout.even_at, 5, 0, 40, true, of_alike, of_details, alike.data()},
                               {48, 1, 40, 5, false, of_last, of_details, each.data()}};
    for (const std::size_t count : {1u, 2u, 4u}) {
        for (const int children : {0, 1, 2}) {
            Numbers details = some_numbers(9 * layout.size, 0.7);
            const Numbers before = details;
            Numbers front(12 * layout.size, 42.0), behind(12 * layout.size, 42.0);
            RowsToDraw rows{n, count, normals.data(), 2 * n, parents.data(), details.data(), apart};
            rows.front = children > 0 ? front.data() : nullptr;
            rows.behind = children > 1 ? behind.data() : nullptr;
            rows.children_apart = children_apart;
            draw_rows(pieces, rows);
            for (std::size_t r = 0; r < count; ++r) {
                const double *p = parents.data() + r * apart, *old = before.data() + r * apart;
                for (std::size_t t = 0; t < 48; ++t) {
                    const auto at = static_cast<std::ptrdiff_t>(t);
                    double e = t < 45 ? normals[2 * n * r + t] : 0.0;
                    if (t < 40) {
                        e *= alike[0];
                        for (std::size_t k = 0; k < 3; ++k) e += alike[k + 1] * p[of_alike[k] + at];
                        e += alike[4] * old[of_details[0] + at];
                    } else {
                        e *= each[t - 40];
                        for (std::size_t k = 0; k < 2; ++k) {
                            e += each[(k + 1) * row_group + t - 40] * p[of_last[k] + at - 40];
                        }
                        e += each[3 * row_group + t - 40] * old[of_details[0] + at - 40];
                    }
                    EXPECT_EQ(details[r * apart + 8 + t], e) << count << " " << r << " " << t;
                    const double parent = p[8 + t];
                    EXPECT_EQ(front[r * children_apart + 8 + t], children > 0 ? parent + e : 42.0);
                    EXPECT_EQ(behind[r * children_apart + 8 + t], children > 1 ? parent - e : 42.0);
                }
                for (const std::size_t zero :
                     {std::size_t{0}, layout.odd_at - 1, layout.size - 1}) {
                    EXPECT_EQ(details[r * apart + zero], 0.0);
                    EXPECT_EQ(front[r * children_apart + zero], children > 0 ? 0.0 : 42.0);
                }
            }
            for (std::size_t t = 0; t < layout.size; ++t) {  // the row between is left alone
                EXPECT_EQ(details[layout.size + t], before[layout.size + t]);
            }
        }
    }
}

TEST(HalvingRows, HalvesAlongARowStandInTurns) {
    for (std::size_t n = 1; n < 70; ++n) {
        const RowLayout layout(n);
        const Numbers p = some_numbers(layout.size, 0.2), e = some_numbers(layout.size, 0.5);
        for (const std::size_t halves : {2 * n, 2 * n - 1}) {
            const RowLayout of_children(halves);
            Numbers children(of_children.size + 8, 42.0);
            halve_along_row(n, halves, p.data(), e.data(), children.data());
            Numbers expected(of_children.size, 0.0);
            for (std::size_t i = 0; i < halves; ++i) {
                const std::size_t at = layout.place(i / 2);
                expected[of_children.place(i)] = i % 2 == 0 ? p[at] + e[at] : p[at] - e[at];
            }
            for (std::size_t t = 0; t < of_children.size; ++t) EXPECT_EQ(children[t], expected[t]);
            EXPECT_EQ(children[of_children.size], 42.0);
        }
    }
}

TEST(HalvingRows, InOrderAndAsColumns) {
    for (std::size_t n = 1; n < 40; ++n) {
        const RowLayout layout(n);
        constexpr std::size_t most = 19;
        const std::size_t apart = 3 * layout.size;
        const Numbers rows = some_numbers(most * apart, 0.2);
        std::vector<double> order(n + 1, 42.0);
        row_in_order(n, rows.data(), order.data());
        for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(order[i], rows[layout.place(i)]);
        EXPECT_EQ(order[n], 42.0);
        for (std::size_t count = 1; count <= most; ++count) {
            const std::size_t stride = count + 3;
            std::vector<double> table(n * stride, 42.0);
            rows_to_columns(n, count, apart, rows.data(), stride, table.data());
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t r = 0; r < stride; ++r) {
                    EXPECT_EQ(table[i * stride + r],
                              r < count ? rows[r * apart + layout.place(i)] : 42.0);
                }
            }
        }
    }
}

}  // namespace
}  // namespace grainfield::randomfield
