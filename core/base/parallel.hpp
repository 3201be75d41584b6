#pragma once
// Loops and sums over chunks of fixed size, so that no result depends on the number of threads:
// a chunk is computed by one thread, and chunks are added in their order.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace grainfield::core {

inline constexpr std::size_t chunk_size = 512;

inline std::size_t chunk_count(std::size_t n) {
    return (n + chunk_size - 1) / chunk_size;
}

/// Calls body(chunk, begin, end) for every chunk of 0..n. Below a few chunks threads cost more
/// than they bring, and the loop runs in the calling thread.
template <class Body>
void for_chunks(std::size_t n, const Body& body) {
    const auto chunks = static_cast<std::ptrdiff_t>(chunk_count(n));
#pragma omp parallel for schedule(static) if (chunks > 8)
    for (std::ptrdiff_t c = 0; c < chunks; ++c) {
        const std::size_t begin = static_cast<std::size_t>(c) * chunk_size;
        body(static_cast<std::size_t>(c), begin, std::min(n, begin + chunk_size));
    }
}

/// Calls body(k) for every k of 0..n, each a piece of work worth a thread.
template <class Body>
void for_pieces(std::size_t n, const Body& body) {
    const auto pieces = static_cast<std::ptrdiff_t>(n);
#pragma omp parallel for schedule(static) if (pieces > 8)
    for (std::ptrdiff_t k = 0; k < pieces; ++k) body(static_cast<std::size_t>(k));
}

/// Sum over chunks of body(begin, end), added in the order of the chunks.
template <class T, class Body>
T sum_chunks(std::size_t n, const Body& body) {
    std::vector<T> partial(chunk_count(n));
    for_chunks(n, [&](std::size_t c, std::size_t begin, std::size_t end) {
        partial[c] = body(begin, end);
    });
    T sum{};
    for (const T& p : partial) sum += p;
    return sum;
}

/// Sum over i of value(i).
template <class T, class Value>
T sum_over(std::size_t n, const Value& value) {
    return sum_chunks<T>(n, [&](std::size_t begin, std::size_t end) {
        T sum{};
        for (std::size_t i = begin; i < end; ++i) sum += value(i);
        return sum;
    });
}

}  // namespace grainfield::core
