#pragma once
// Wall time of work that may have begun before an interruption.

#include <chrono>

namespace grainfield::core {

class Stopwatch {
  public:
    double seconds() const {  ///< since the start, without what lay between two runs [s]
        return before_ + std::chrono::duration<double>(Clock::now() - start_).count();
    }
    /// Seconds so far, and starts again [s].
    double lap() {
        const double passed = seconds();
        *this = {};
        return passed;
    }

    template <class Archive>
    void save(Archive& archive) const {
        archive(seconds());
    }
    template <class Archive>
    void load(Archive& archive) {
        archive(before_);
        start_ = Clock::now();
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
    double before_ = 0;  // [s]
};

}  // namespace grainfield::core
