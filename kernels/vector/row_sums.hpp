#pragma once
// Weighted sums of rows in double, the inner loops of random fields, in the widest vectors of this
// machine. Every number is one sum in the order given, multiplied and rounded term by term: the
// same bits on every instruction set.

#include <cstddef>
#include <span>

namespace grainfield::kernels {

/// A row `offset` numbers from a base, and its weight.
struct RowTerm {
    std::ptrdiff_t offset;  ///< [numbers]
    double weight;          ///< [-]
};

/// out[t] = scale first[t] + sum over a of weight_a a_base[offset_a + t] + the same over b,
/// t < count. `out` overlaps none of what is read.
void sum_rows(std::size_t count, double scale, const double* first, const double* a_base,
              std::span<const RowTerm> a, const double* b_base, std::span<const RowTerm> b,
              double* out);

/// product[i] = sum over j <= i of l[i + j size] x[j], in ascending j: a lower triangular matrix,
/// column by column, times a vector of `size`.
void multiply_lower(std::size_t size, const double* l, const double* x, double* product);

/// Edge of the tiles of subtract_products().
inline constexpr std::size_t product_tile = 32;

/// tile(r, c) -= sum over k < terms of rows[r + k size] factors[c + k size], in ascending k, for
/// r < product_tile and c < columns; tile(r, c) at [r + c product_tile]. `rows` must be readable
/// for product_tile numbers in each of its columns.
void subtract_products(std::size_t size, std::size_t terms, const double* rows,
                       const double* factors, std::size_t columns, double* tile);

}  // namespace grainfield::kernels
