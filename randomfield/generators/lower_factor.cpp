#include "randomfield/generators/lower_factor.hpp"

#include <algorithm>
#include <cmath>

#include "randomfield/generators/row_sums.hpp"

namespace grainfield::randomfield {
namespace {

constexpr std::size_t kTile = product_tile;  // columns finished at a time, and rows of one update

// a(i, j) -= sum over k < first of l(i, k) l(j, k), in ascending k, for the tile of rows
// [row, row + kTile) and columns [first, last). One accumulator an entry: no sum is ever split.
void update_tile(double* a, std::size_t n, std::size_t row, std::size_t first, std::size_t last) {
    const std::size_t rows = std::min(kTile, n - row);
    double tile[kTile][kTile];
    const std::size_t columns = last - first;
    for (std::size_t c = 0; c < columns; ++c) {
        std::copy_n(a + row + (first + c) * n, rows, tile[c]);
    }
    if (rows == kTile) {
        subtract_products(n, first, a + row, a + first, columns, tile[0]);
    } else {
        for (std::size_t k = 0; k < first; ++k) {
            const double* l = a + row + k * n;
            for (std::size_t c = 0; c < columns; ++c) {
                const double factor = a[first + c + k * n];
                for (std::size_t r = 0; r < rows; ++r) tile[c][r] -= l[r] * factor;
            }
        }
    }
    for (std::size_t c = 0; c < columns; ++c) {
        const std::size_t skip = first + c > row ? first + c - row : 0;  // above the diagonal
        if (skip < rows) {
            std::copy_n(tile[c] + skip, rows - skip, a + row + skip + (first + c) * n);
        }
    }
}

// Factors the columns [first, last) once all earlier columns are taken off. False at a pivot that
// is not positive (or not a number).
bool factor_columns(double* a, std::size_t n, std::size_t first, std::size_t last) {
    for (std::size_t j = first; j < last; ++j) {
        double* column = a + j * n;
        for (std::size_t k = first; k < j; ++k) {
            const double* l = a + k * n;
            const double factor = l[j];
            for (std::size_t i = j; i < n; ++i) column[i] -= l[i] * factor;
        }
        if (!(column[j] > 0.0) || !std::isfinite(column[j])) return false;
        const double pivot = std::sqrt(column[j]);
        column[j] = pivot;
        for (std::size_t i = j + 1; i < n; ++i) column[i] /= pivot;
    }
    return true;
}

// Left-looking Cholesky in place. Where it runs to its end its error is at most (n + 1) eps
// sqrt(c_ii c_jj) an entry, however near to singular the matrix is (Higham 2002, Theorem 10.3).
bool factor_in_place(double* a, std::size_t n) {
    for (std::size_t first = 0; first < n; first += kTile) {
        const std::size_t last = std::min(n, first + kTile);
        // Reads finished columns only: the tiles are independent.
#pragma omp parallel for schedule(dynamic) if (n > 1024)
        for (std::size_t row = first; row < n; row += kTile) update_tile(a, n, row, first, last);
        if (!factor_columns(a, n, first, last)) return false;
    }
    return true;
}

}  // namespace

std::optional<LowerFactor> LowerFactor::of(std::vector<double> matrix, std::size_t size,
                                           double scale) {
    std::vector<double> diagonal(size);
    for (std::size_t j = 0; j < size; ++j) diagonal[j] = matrix[j * (size + 1)];
    for (const double d : diagonal) scale = std::max(scale, d);
    if (!(scale > 0.0) || !std::isfinite(scale)) return std::nullopt;
    for (const double nugget : {0.0, 1e-14, 1e-13, 3e-13}) {
        for (std::size_t j = 0; j < size; ++j) {
            matrix[j * (size + 1)] = diagonal[j] + nugget * scale;
            // What lies above the diagonal is not touched: a failed try starts from it again.
            if (nugget == 0.0) continue;
            for (std::size_t i = j + 1; i < size; ++i) matrix[i + j * size] = matrix[j + i * size];
        }
        if (!factor_in_place(matrix.data(), size)) continue;
        for (std::size_t j = 0; j < size; ++j) std::fill_n(matrix.data() + j * size, j, 0.0);
        return LowerFactor(std::move(matrix), size, nugget);
    }
    return std::nullopt;
}

void LowerFactor::multiply(std::span<const double> x, std::span<double> product) const {
    multiply_lower(size_, entries_.data(), x.data(), product.data());
}

void LowerFactor::solve_lower(std::span<double> x) const {
    for (std::size_t j = 0; j < size_; ++j) {
        const double* column = entries_.data() + j * size_;
        x[j] /= column[j];
        for (std::size_t i = j + 1; i < size_; ++i) x[i] -= column[i] * x[j];
    }
}

void LowerFactor::solve_upper(std::span<double> x) const {
    for (std::size_t j = size_; j-- > 0;) {
        const double* column = entries_.data() + j * size_;
        double sum = x[j];
        for (std::size_t i = j + 1; i < size_; ++i) sum -= column[i] * x[i];
        x[j] = sum / column[j];
    }
}

}  // namespace grainfield::randomfield
