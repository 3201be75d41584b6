// Adds to GoogleTest's report of each test the processor time that it took, its children's too: on
// a busy machine the clock says little of a test. See tests/repository/test_times.py.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/time.h>

#include <string>

namespace grainfield {
namespace {

/// Of this process and of those that it has waited for [s].
double processor_seconds() {
    double seconds = 0;
    for (const auto who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage usage{};
        getrusage(who, &usage);
        for (const timeval& t : {usage.ru_utime, usage.ru_stime})
            seconds += static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    }
    return seconds;
}

class ProcessorTime : public testing::EmptyTestEventListener {
    void OnTestStart(const testing::TestInfo& /*test*/) override { before_ = processor_seconds(); }
    void OnTestEnd(const testing::TestInfo& /*test*/) override {
        testing::Test::RecordProperty("processor_seconds",
                                      std::to_string(processor_seconds() - before_));
    }
    double before_ = 0;
};

[[maybe_unused]] const bool listening = [] {
    testing::UnitTest::GetInstance()->listeners().Append(new ProcessorTime);
    return true;
}();

}  // namespace
}  // namespace grainfield
