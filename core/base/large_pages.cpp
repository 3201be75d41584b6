#include "core/base/large_pages.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <boost/interprocess/managed_external_buffer.hpp>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>

namespace grainfield::core {
namespace {

namespace ip = boost::interprocess;

constexpr std::size_t large_page = std::size_t{2} << 20;  // [B]

// The sanitizers have to see every block. g++ and clang say each in its own way that they are on.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define GRAINFIELD_SANITIZED
#endif
#endif
#if defined(GRAINFIELD_SANITIZED) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool large_pages_wanted = false;
#else
constexpr bool large_pages_wanted = true;
#endif

/// Addresses for as much as the machine has; memory comes with the first use of a page. Boost
/// manages the blocks in it: best fit, neighbours joined when they are free.
class Region {
  public:
    Region() {
        if (!large_pages_wanted) return;
        const auto pages = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES));
        size_ = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / large_page * large_page;
        void* place = mmap(nullptr, size_ + large_page, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (place == MAP_FAILED) return;
        void* begin = place;
        std::size_t room = size_ + large_page;
        std::align(large_page, size_, begin, room);
        madvise(begin, size_, MADV_HUGEPAGE);  // where the system has none, pages stay small
        begin_ = static_cast<char*>(begin);
        buffer_ = ip::managed_external_buffer(ip::create_only, begin, size_);
    }

    bool holds(const void* block) const {
        const auto at = reinterpret_cast<std::uintptr_t>(block);
        const auto first = reinterpret_cast<std::uintptr_t>(begin_);
        return begin_ != nullptr && at >= first && at < first + size_;
    }
    void* allocate(std::size_t bytes, std::size_t alignment) {
        if (begin_ == nullptr) return nullptr;
        const std::lock_guard lock(mutex_);
        return buffer_.allocate_aligned(bytes, alignment, std::nothrow);
    }
    void free(void* block) {
        const std::lock_guard lock(mutex_);
        buffer_.deallocate(block);
    }
    std::size_t in_use() {
        const std::lock_guard lock(mutex_);
        return begin_ == nullptr ? 0 : buffer_.get_size() - buffer_.get_free_memory();
    }

  private:
    char* begin_ = nullptr;
    std::size_t size_ = 0;
    std::mutex mutex_;
    ip::managed_external_buffer buffer_;  // takes no locks itself
};

/// Never destroyed: objects of static storage may still give blocks back.
Region& region() {
    static Region& only = *new Region;
    return only;
}

}  // namespace

void* allocate_large(std::size_t bytes, std::size_t alignment) noexcept {
    return region().allocate(bytes, alignment);
}

bool free_large(void* block) noexcept {
    if (!region().holds(block)) return false;
    region().free(block);
    return true;
}

std::size_t large_bytes_in_use() noexcept {
    return region().in_use();
}

}  // namespace grainfield::core
