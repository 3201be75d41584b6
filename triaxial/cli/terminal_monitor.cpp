#include "triaxial/cli/terminal_monitor.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "triaxial/cli/interrupt.hpp"
#include "triaxial/cli/standard_streams.hpp"

namespace grainfield::triaxial {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds terminal_interval{0.2};
constexpr Seconds plain_interval{10.0};

std::size_t terminal_width() {
    struct winsize size {};
    if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return 80;
    return size.ws_col;
}

std::string rate_text(double rate) {
    return rate < 100 ? fmt::format("{:.3g} steps/s", rate) : fmt::format("{:.0f} steps/s", rate);
}

}  // namespace

std::string duration_text(double seconds) {
    if (!(seconds < 1e9)) return "very long";
    if (seconds < 10) return fmt::format("{:.2f} s", seconds);
    const auto whole = static_cast<std::int64_t>(std::lround(seconds));
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

TerminalMonitor::TerminalMonitor(bool quiet)
    : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

TerminalMonitor::~TerminalMonitor() {
    if (line_open_) write_log("\n");
}

void TerminalMonitor::begin(std::string_view stage) {
    finish();
    stage_ = stage;
    started_ = shown_ = Clock::now();
    first_steps_ = last_steps_ = -1;
    if (quiet_ || !terminal_) return;
    write_log(stage_ + " ...");
    line_open_ = true;
}

void TerminalMonitor::progress(double done, std::int64_t steps, std::string_view detail) {
    const Clock::time_point now = Clock::now();
    if (first_steps_ < 0) {
        first_steps_ = steps;
        first_report_ = now;
    }
    last_steps_ = steps;
    if (quiet_ || now - shown_ < (terminal_ ? terminal_interval : plain_interval)) return;
    shown_ = now;
    std::string line = text(done, steps, detail);
    if (!terminal_) {
        write_log(line + "\n");
        return;
    }
    clear_line();
    line.resize(std::min(line.size(), terminal_width() - 1));  // a wrapped line cannot be rewritten
    write_log(line);
    line_open_ = true;
}

std::string TerminalMonitor::text(double done, std::int64_t steps, std::string_view detail) const {
    const Clock::time_point now = Clock::now();
    std::string line = stage_.empty() ? "working" : stage_;
    if (done >= 0) line += fmt::format("  {:.1f} %", 100 * std::min(done, 1.0));
    if (steps >= 0) line += fmt::format("  {} steps", steps);
    const double measured = Seconds(now - first_report_).count();
    if (measured > 0 && steps > first_steps_)
        line += "  " + rate_text(static_cast<double>(steps - first_steps_) / measured);
    const double elapsed = Seconds(now - started_).count();
    if (done > 0 && done < 1) line += "  left " + duration_text(elapsed * (1 - done) / done);
    if (!detail.empty()) line += fmt::format("  {}", detail);
    return line;
}

void TerminalMonitor::note(const std::string& line) {
    if (quiet_) return;
    clear_line();
    write_log(line + "\n");
}

void TerminalMonitor::finish() {
    if (stage_.empty()) return;
    const double seconds = Seconds(Clock::now() - started_).count();
    std::string line = fmt::format("{}: {}", stage_, duration_text(seconds));
    if (last_steps_ > first_steps_) line += fmt::format(", {} steps", last_steps_ - first_steps_);
    note(line);
    stage_.clear();
}

bool TerminalMonitor::stop_requested() const {
    return interrupt_requested();
}

void TerminalMonitor::clear_line() {
    if (!line_open_) return;
    write_log("\r\x1b[K");
    line_open_ = false;
}

}  // namespace grainfield::triaxial
