#include "core/base/large_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

#include "core/base/aligned.hpp"
#include "core/base/random.hpp"

namespace grainfield::core {
namespace {

struct Block {
    unsigned char* at;
    std::size_t bytes;
    unsigned char mark;
};

bool intact(const Block& block) {
    for (std::size_t k = 0; k < block.bytes; ++k)
        if (block.at[k] != block.mark) return false;
    return true;
}

TEST(LargePages, BlocksOfSeveralThreadsAreApartAndComeBack) {
    const auto work = [](unsigned char thread) {
        const RandomStream random(thread, Stream::perturbation);
        std::vector<Block> blocks;
        for (std::uint64_t k = 0; k < 400; ++k) {
            const auto bytes = static_cast<std::size_t>(1000 + 60000 * random.uniform(0, k));
            void* place = allocate_large(bytes, 64);
            if (place == nullptr) return false;
            const auto mark = static_cast<unsigned char>(64 * thread + k % 64);
            std::memset(place, mark, bytes);
            blocks.push_back({static_cast<unsigned char*>(place), bytes, mark});
            if (reinterpret_cast<std::uintptr_t>(place) % 64 != 0) return false;
            if (k % 2 == 0) continue;
            const auto gone =
                static_cast<std::size_t>(random.uniform(1, k) * static_cast<double>(blocks.size()));
            if (!intact(blocks[gone]) || !free_large(blocks[gone].at)) return false;
            blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(gone));
        }
        bool good = true;
        for (const Block& block : blocks) good = good && intact(block) && free_large(block.at);
        return good;
    };
    if (void* block = allocate_large(1, 64))
        free_large(block);
    else
        GTEST_SKIP() << "no region of large pages here (under the sanitizers there is none)";
    std::vector<char> good(3, 0);
    std::vector<std::thread> threads;
    for (unsigned char t = 0; t < 3; ++t)
        threads.emplace_back([&, t] { good[t] = work(t) ? 1 : 0; });
    for (std::thread& thread : threads) thread.join();
    for (const char g : good) EXPECT_TRUE(g != 0);
}

TEST(LargePages, LeavesBlocksOfOthersAlone) {
    std::vector<int> other(100000);
    EXPECT_FALSE(free_large(other.data()));
}

/// More than the machine has, in turns: a vector that did not give its memory back would end this.
TEST(LargePages, VectorsGiveTheirMemoryBack) {
    constexpr std::size_t n = std::size_t{1} << 30;
    for (int k = 0; k < 200; ++k) {
        Aligned<char> block;
        block.reserve(n);  // addresses only: nothing is written
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block.data()) % 64, 0u);
    }
}

}  // namespace
}  // namespace grainfield::core
