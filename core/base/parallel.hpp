#pragma once
// Loops and sums over chunks of fixed size, so that no result depends on the number of threads:
// a chunk is computed by one thread, and chunks are added in their order.

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace grainfield::core {

inline constexpr std::size_t chunk_size = 512;

inline std::size_t chunk_count(std::size_t n) {
    return (n + chunk_size - 1) / chunk_size;
}

/// Calls body(k) for every k of 0..n: in threads where there are more than `few`, else in the
/// calling one. Even one thread would end a parallel region with a system call.
template <class Body>
void for_many(std::size_t n, std::size_t few, const Body& body) {
    if (n <= few || omp_get_max_threads() == 1) {
        for (std::size_t k = 0; k < n; ++k) body(k);
        return;
    }
#pragma omp parallel for schedule(static)
    for (std::size_t k = 0; k < n; ++k) body(k);
}

/// Calls body(chunk, begin, end) for every chunk of 0..n. Below a few chunks threads cost more
/// than they bring.
template <class Body>
void for_chunks(std::size_t n, const Body& body) {
    for_many(chunk_count(n), 8, [&](std::size_t c) {
        const std::size_t begin = c * chunk_size;
        body(c, begin, std::min(n, begin + chunk_size));
    });
}

/// Calls body(k) for every k of 0..n, each a piece of work worth a thread.
template <class Body>
void for_pieces(std::size_t n, const Body& body) {
    for_many(n, 8, body);
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
