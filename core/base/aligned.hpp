#pragma once
// Memory on cache lines; large arrays on large pages.

#include <cstddef>
#include <new>
#include <vector>

#include "core/base/large_pages.hpp"

namespace grainfield::core {

/// Allocates on 64-byte lines, or coarser where the type asks for it.
template <class T>
struct LineAllocator {
    using value_type = T;
    static constexpr std::align_val_t alignment{alignof(T) > 64 ? alignof(T) : 64};  // [B]
    LineAllocator() = default;
    template <class U>
    LineAllocator(const LineAllocator<U>&) {}
    T* allocate(std::size_t n) {
        const std::size_t bytes = n * sizeof(T);
        if (bytes >= least_large_block)
            if (void* block = allocate_large(bytes, static_cast<std::size_t>(alignment)))
                return static_cast<T*>(block);
        return static_cast<T*>(::operator new(bytes, alignment));
    }
    void deallocate(T* p, std::size_t n) {
        if (n * sizeof(T) >= least_large_block && free_large(p)) return;
        ::operator delete(p, alignment);
    }
    bool operator==(const LineAllocator&) const { return true; }
};

template <class T>
using Aligned = std::vector<T, LineAllocator<T>>;

/// Resizes a list whose length changes a little every time. It grows with 3 % to spare; a vector
/// would double its memory, most of it never used.
template <class Column>
void resize_list(Column& column, std::size_t n) {
    if (column.capacity() < n) {
        Column wider;
        wider.reserve(n + n / 32);
        wider.assign(column.begin(), column.end());
        column.swap(wider);
    }
    column.resize(n);
}

}  // namespace grainfield::core
