// Sums of rows: the same bits as plain loops, whatever vectors this machine has.

#include "randomfield/generators/row_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace grainfield::randomfield {
namespace {

std::vector<double> some_values(std::size_t count, double phase) {
    std::vector<double> x(count);
    for (std::size_t i = 0; i < count; ++i) x[i] = std::sin(phase + 1.7 * static_cast<double>(i));
    return x;
}

// No tolerance: products and sums are rounded apart, in the same order.
TEST(RowSums, LowerProductsAreThePlainOnesToTheLastBit) {
    for (std::size_t n = 1; n < 40; ++n) {
        const std::vector<double> l = some_values(n * n, 0.2), x = some_values(n, 0.5);
        std::vector<double> product(n, std::nan(""));
        multiply_lower(n, l.data(), x.data(), product.data());
        for (std::size_t i = 0; i < n; ++i) {
            double sum = 0.0;
            for (std::size_t j = 0; j <= i; ++j) sum += l[i + j * n] * x[j];
            EXPECT_EQ(product[i], sum) << n << " " << i;
        }
    }
}

TEST(RowSums, SubtractedProductsAreThePlainOnesToTheLastBit) {
    constexpr std::size_t n = 80, terms = 37;
    const std::vector<double> a = some_values(n * terms, 0.3);
    for (std::size_t columns = 1; columns <= product_tile; ++columns) {
        std::vector<double> tile = some_values(product_tile * product_tile, 0.6);
        std::vector<double> plain = tile;
        subtract_products(n, terms, a.data() + 40, a.data() + 2, columns, tile.data());
        for (std::size_t c = 0; c < columns; ++c) {
            for (std::size_t r = 0; r < product_tile; ++r) {
                double& sum = plain[r + c * product_tile];
                for (std::size_t k = 0; k < terms; ++k) sum -= a[40 + r + k * n] * a[2 + c + k * n];
            }
        }
        EXPECT_EQ(tile, plain) << columns;
    }
}

}  // namespace
}  // namespace grainfield::randomfield
