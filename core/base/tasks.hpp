#pragma once
// Tasks of TBB's, for work that OpenMP's loops divide badly. ThreadSanitizer does not see how TBB's
// threads wait for each other, for Debian's TBB is not compiled under it; in a build under it these
// tell it: what came before the tasks happened before each of them, and each before what follows.

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <cstddef>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define GRAINFIELD_UNDER_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif
#endif

namespace grainfield::core {

/// The beginning of tasks, seen by each of them, and their ends, seen by who waits for all.
class TaskOrder {
  public:
#ifdef GRAINFIELD_UNDER_THREAD_SANITIZER
    TaskOrder() {
        __tsan_release(&begun_);
    }
    ~TaskOrder() {
        __tsan_acquire(&ended_);
    }
    template <class Task>
    void run(const Task& task) {
        __tsan_acquire(&begun_);
        task();
        __tsan_release(&ended_);
    }

  private:
    char begun_ = 0, ended_ = 0;  // their addresses are what counts
#else
    template <class Task>
    void run(const Task& task) {
        task();
    }
#endif
};

/// Calls body(k) for every k of 0..n, as many at once as there are threads for.
template <class Body>
void for_tasks(std::size_t n, const Body& body) {
    TaskOrder order;
    tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) { order.run([&] { body(k); }); });
}

/// Calls both, at once if there is a thread for it.
template <class First, class Second>
void both(const First& first, const Second& second) {
    TaskOrder order;
    tbb::parallel_invoke([&] { order.run(first); }, [&] { order.run(second); });
}

}  // namespace grainfield::core
