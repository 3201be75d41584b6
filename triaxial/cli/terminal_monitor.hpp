#pragma once
// Progress on stderr: one line rewritten in place on a terminal, else a plain line now and then.

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/monitor.hpp"

namespace grainfield::triaxial {

/// Shows stage, share done, steps, steps/s, time left and the work's own figures. A stage ends when
/// the next begins or at finish(), with a line of its time. stop_requested() is true after SIGINT
/// or SIGTERM.
class TerminalMonitor final : public core::Monitor {
  public:
    explicit TerminalMonitor(bool quiet);
    /// Leaves the cursor on a fresh line; a stage that did not end (an exception) gets no line.
    ~TerminalMonitor() override;
    TerminalMonitor(const TerminalMonitor&) = delete;
    TerminalMonitor& operator=(const TerminalMonitor&) = delete;

    void begin(std::string_view stage) override;
    void progress(double done, std::int64_t steps, std::string_view detail) override;
    void note(const std::string& line) override;
    bool stop_requested() const override;

    /// Ends the last stage.
    void finish();

  private:
    using Clock = std::chrono::steady_clock;

    std::string text(double done, std::int64_t steps, std::string_view detail) const;
    void clear_line();

    bool quiet_;
    bool terminal_;
    bool line_open_ = false;  // something stands on the terminal's current line
    std::string stage_;       // empty: none
    Clock::time_point started_{};
    Clock::time_point shown_{};
    std::int64_t first_steps_ = -1;  // of the stage's first report; rates count from there
    std::int64_t last_steps_ = -1;
    Clock::time_point first_report_{};
};

/// "0.42 s", "12 s", "3 min 05 s", "2 h 14 min".
std::string duration_text(double seconds);

}  // namespace grainfield::triaxial
