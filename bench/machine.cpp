#include "bench/machine.hpp"

#include <malloc.h>
#include <omp.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <vector>

#include "core/base/large_pages.hpp"

namespace grainfield::bench {

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (!line.starts_with("model name")) continue;
        std::string name;
        for (const char c : line.substr(line.find(':') + 2))
            name += std::isalnum(static_cast<unsigned char>(c))
                        ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                        : '-';
        return name;
    }
    return "unknown-cpu";
}

double triad_bandwidth(std::size_t bytes) {
    const auto n = static_cast<std::ptrdiff_t>(bytes / 24);
    std::vector<double> a(static_cast<std::size_t>(n), 0.0), b = a, c = a;
    const int repeats =
        std::max(1, static_cast<int>(std::size_t{1} << 30) / static_cast<int>(bytes));
    double best = 0;
    for (int run = 0; run < 5; ++run) {
        const double start = omp_get_wtime();
        for (int r = 0; r < repeats; ++r) {
            const double s = 1e-9 * (run + r);
#pragma omp parallel for schedule(static)
            for (std::ptrdiff_t i = 0; i < n; ++i)
                a[static_cast<std::size_t>(i)] =
                    b[static_cast<std::size_t>(i)] + s * c[static_cast<std::size_t>(i)];
        }
        const double seconds = omp_get_wtime() - start;
        best = std::max(best, 24.0 * static_cast<double>(n) * repeats / seconds);
    }
    return best;
}

std::size_t bytes_in_use() {
    // What was freed stays resident and counts no more.
    const struct mallinfo2 heap = mallinfo2();
    return heap.uordblks + heap.hblkhd + core::large_bytes_in_use();
}

}  // namespace grainfield::bench
