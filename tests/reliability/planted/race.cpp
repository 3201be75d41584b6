// Two threads add to one number. With GOOD they wait for each other, in the ways that the solver's
// work does: by the end of a parallel region, of a loop in it, and of tasks.

#include <atomic>
#include <cstdio>
#include <vector>

#include "core/base/tasks.hpp"

int main() {
    std::vector<long> parts(64);
    long sum = 0;
#pragma omp parallel
    {
#pragma omp for schedule(dynamic, 1)
        for (int i = 0; i < 64; ++i) parts[static_cast<std::size_t>(i)] = i;
#pragma omp for schedule(static)
        for (int i = 0; i < 64; ++i) parts[static_cast<std::size_t>(63 - i)] += 1;
    }
#ifdef TASKS
    // Tasks that wait for each other once, so that two threads do take part.
    std::atomic<int> here = 0;
    grainfield::core::both(
        [&] {
            for (++here; here < 2;) continue;
            parts[0] += 1;
        },
        [&] {
            for (++here; here < 2;) continue;
#ifdef GOOD
            parts[1] += 1;
#else
            parts[0] += 1;
#endif
        });
    sum = parts[0] + parts[1];
#elif defined(GOOD)
    for (long part : parts) sum += part;
#else
#pragma omp parallel for
    for (int i = 0; i < 64; ++i) sum += parts[static_cast<std::size_t>(i)];
#endif
    std::printf("%ld\n", sum);
}
