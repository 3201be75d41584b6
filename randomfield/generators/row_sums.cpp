#include "randomfield/generators/row_sums.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "randomfield/generators/row_sums.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace grainfield::randomfield::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Add and Mul apart, never MulAdd: plain code, which has no fused one, must get the same bits.
template <class V>
V plus_product(V sum, V a, V b) {
    return hn::Add(sum, hn::Mul(a, b));
}

void multiply_lower(std::size_t size, const double* l, const double* x, double* product) {
    const hn::ScalableTag<double> d;
    constexpr std::size_t n = HWY_LANES(double);
    constexpr std::size_t columns = 8;  // taken at once: the product is read and written less often
    for (std::size_t i = 0; i < size; ++i) product[i] = 0.0;
    std::size_t j = 0;
    for (; j + columns <= size; j += columns) {
        const double* column = l + j * size;
        std::size_t i = j;
        // The triangle on the diagonal; above it the matrix is not read.
        for (std::size_t c = 0; c < columns; ++c) {
            for (std::size_t r = c; r < columns; ++r) {
                product[j + r] += column[c * size + j + r] * x[j + c];
            }
        }
        i += columns;
        const auto block = [&](auto tag) HWY_ATTR {
            auto sum = hn::LoadU(tag, product + i);
            for (std::size_t c = 0; c < columns; ++c) {
                sum = plus_product(sum, hn::LoadU(tag, column + c * size + i),
                                   hn::Set(tag, x[j + c]));
            }
            hn::StoreU(sum, tag, product + i);
        };
        for (; i + n <= size; i += n) block(d);
        for (; i < size; ++i) block(hn::CappedTag<double, 1>());
    }
    for (; j < size; ++j) {
        for (std::size_t i = j; i < size; ++i) product[i] += l[i + j * size] * x[j];
    }
}

void subtract_products(std::size_t size, std::size_t terms, const double* rows,
                       const double* factors, std::size_t columns, double* tile) {
    const hn::CappedTag<double, product_tile> d;
    constexpr std::size_t n = HWY_LANES(double);
    constexpr std::size_t block = 4;  // columns whose sums are kept in registers
    for (std::size_t c0 = 0; c0 < columns; c0 += block) {
        const std::size_t width = c0 + block <= columns ? block : columns - c0;
        for (std::size_t r = 0; r < product_tile; r += n) {
            const auto at = [&](std::size_t c) { return tile + r + (c0 + c) * product_tile; };
            if (width == block) {
                auto s0 = hn::LoadU(d, at(0)), s1 = hn::LoadU(d, at(1));
                auto s2 = hn::LoadU(d, at(2)), s3 = hn::LoadU(d, at(3));
                for (std::size_t k = 0; k < terms; ++k) {
                    const auto l = hn::LoadU(d, rows + r + k * size);
                    const double* f = factors + c0 + k * size;
                    s0 = hn::Sub(s0, hn::Mul(l, hn::Set(d, f[0])));
                    s1 = hn::Sub(s1, hn::Mul(l, hn::Set(d, f[1])));
                    s2 = hn::Sub(s2, hn::Mul(l, hn::Set(d, f[2])));
                    s3 = hn::Sub(s3, hn::Mul(l, hn::Set(d, f[3])));
                }
                hn::StoreU(s0, d, at(0));
                hn::StoreU(s1, d, at(1));
                hn::StoreU(s2, d, at(2));
                hn::StoreU(s3, d, at(3));
                continue;
            }
            for (std::size_t c = 0; c < width; ++c) {
                auto sum = hn::LoadU(d, at(c));
                for (std::size_t k = 0; k < terms; ++k) {
                    sum = hn::Sub(sum, hn::Mul(hn::LoadU(d, rows + r + k * size),
                                               hn::Set(d, factors[c0 + c + k * size])));
                }
                hn::StoreU(sum, d, at(c));
            }
        }
    }
}

}  // namespace grainfield::randomfield::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace grainfield::randomfield {

HWY_EXPORT(multiply_lower);
HWY_EXPORT(subtract_products);

void multiply_lower(std::size_t size, const double* l, const double* x, double* product) {
    HWY_DYNAMIC_DISPATCH(multiply_lower)(size, l, x, product);
}

void subtract_products(std::size_t size, std::size_t terms, const double* rows,
                       const double* factors, std::size_t columns, double* tile) {
    HWY_DYNAMIC_DISPATCH(subtract_products)(size, terms, rows, factors, columns, tile);
}

}  // namespace grainfield::randomfield
#endif
