#pragma once
// Weighted sums of rows in double, the inner loops of random fields, in the widest vectors of this
// machine. Every number is one sum in the order given, multiplied and rounded term by term: the
// same bits on every instruction set.

#include <cstddef>

namespace grainfield::randomfield {

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

}  // namespace grainfield::randomfield
