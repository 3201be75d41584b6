// Progress as a user sees it: one line rewritten in place on a terminal, few lines elsewhere.

#include "triaxial/cli/terminal_monitor.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <limits>
#include <string>
#include <thread>

namespace grainfield::triaxial {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

/// What stderr gets while it is a terminal so many columns wide, or a pipe where that is 0.
class Captured {
  public:
    explicit Captured(unsigned short columns) {
        int ends[2] = {-1, -1};  // to read from, to write to
        if (columns > 0) {
            struct winsize size {};
            size.ws_row = 24;
            size.ws_col = columns;
            EXPECT_EQ(::openpty(&ends[0], &ends[1], nullptr, nullptr, &size), 0);
        } else {
            EXPECT_EQ(::pipe(ends), 0);
        }
        std::fflush(stderr);
        saved_ = ::dup(STDERR_FILENO);
        ::dup2(ends[1], STDERR_FILENO);
        ::close(ends[1]);
        from_ = ends[0];
        ::fcntl(from_, F_SETFL, O_NONBLOCK);
    }
    ~Captured() {
        std::fflush(stderr);
        ::dup2(saved_, STDERR_FILENO);
        ::close(saved_);
        ::close(from_);
    }
    Captured(const Captured&) = delete;
    Captured& operator=(const Captured&) = delete;

    std::string take() const {
        std::fflush(stderr);
        std::string text;
        char bytes[4096];
        for (ssize_t n; (n = ::read(from_, bytes, sizeof bytes)) > 0;)
            text.append(bytes, static_cast<std::size_t>(n));
        return text;
    }

  private:
    int saved_ = -1, from_ = -1;
};

/// Longer than a terminal waits between two lines.
void a_moment() {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
}

TEST(TerminalMonitor, RewritesItsLineOnATerminal) {
    const Captured terminal(80);
    TerminalMonitor monitor(false);
    monitor.begin("shearing");
    EXPECT_EQ(terminal.take(), "shearing ...");
    monitor.progress(0.1, 1000, "");
    EXPECT_EQ(terminal.take(), "") << "too soon";
    a_moment();
    monitor.progress(0.5, 1100, "q = 70 kPa");
    EXPECT_THAT(terminal.take(), AllOf(StartsWith("\r\x1b[Kshearing  50.0 %  1100 steps  "),
                                       HasSubstr(" steps/s  left 0."), EndsWith(" s  q = 70 kPa")));
    monitor.note("a note");
    EXPECT_EQ(terminal.take(), "\r\x1b[Ka note\r\n");
    monitor.begin("next");
    EXPECT_THAT(terminal.take(),
                MatchesRegex("shearing: 0\\.[0-9]+ s, 100 steps\r\nnext \\.\\.\\."));
}

TEST(TerminalMonitor, CutsWhatIsTooWide) {
    for (const auto& [columns, shown] : {std::pair<unsigned short, std::size_t>{30, 29}, {5, 79}}) {
        const Captured terminal(columns);
        TerminalMonitor monitor(false);
        monitor.begin("packing");
        a_moment();
        terminal.take();
        monitor.progress(-1, -1, std::string(100, 'x'));
        const std::string text = terminal.take();
        EXPECT_THAT(text, StartsWith("\r\x1b[Kpacking  xxx"));
        EXPECT_EQ(text.size(), shown + 4) << "and the four that clear the line";
    }
}

TEST(TerminalMonitor, LeavesAFreshLineWhereAStageBreaks) {
    const Captured terminal(80);
    { TerminalMonitor(false).begin("packing"); }
    EXPECT_EQ(terminal.take(), "packing ...\r\n");
}

TEST(TerminalMonitor, WritesAStagesTimeIntoAFile) {
    const Captured pipe(0);
    TerminalMonitor monitor(false);
    monitor.begin("shearing");
    a_moment();
    monitor.progress(0.5, 100, "");
    EXPECT_EQ(pipe.take(), "") << "a line every ten seconds";
    monitor.finish();
    EXPECT_THAT(pipe.take(), MatchesRegex("shearing: 0\\.[0-9]+ s\n"));
    monitor.finish();
    EXPECT_EQ(pipe.take(), "") << "once";
}

TEST(TerminalMonitor, SaysNothingWhenQuiet) {
    const Captured terminal(80);
    TerminalMonitor monitor(true);
    monitor.begin("shearing");
    a_moment();
    monitor.progress(0.5, 100, "");
    monitor.note("a note");
    monitor.finish();
    EXPECT_EQ(terminal.take(), "");
}

TEST(TerminalMonitor, SaysDurations) {
    EXPECT_EQ(duration_text(0.416), "0.42 s");
    EXPECT_EQ(duration_text(12.3), "12 s");
    EXPECT_EQ(duration_text(185), "3 min 05 s");
    EXPECT_EQ(duration_text(8045), "2 h 14 min");
    EXPECT_EQ(duration_text(std::numeric_limits<double>::infinity()), "very long");
}

}  // namespace
}  // namespace grainfield::triaxial
