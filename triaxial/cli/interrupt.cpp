#include "triaxial/cli/interrupt.hpp"

#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>

namespace grainfield::triaxial {
namespace {

// All that a handler touches: lock-free, hence safe to touch there.
std::atomic<bool> requested{false};
std::atomic<bool> at_once{false};
static_assert(std::atomic<bool>::is_always_lock_free);

constexpr int interrupted = 130;  // the exit code

/// One request may come twice: `timeout` sends its signal to the process and to its group.
constexpr std::int64_t same_request = 500'000'000;  // [ns]
std::atomic<std::int64_t> first_request{0};         // on the monotonic clock [ns]
static_assert(std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t now() {
    timespec t{};
    ::clock_gettime(CLOCK_MONOTONIC, &t);
    return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

extern "C" void on_signal(int signal) {
    if (at_once.load()) ::_exit(interrupted);
    const std::int64_t time = now();
    std::int64_t none = 0;
    if (first_request.compare_exchange_strong(none, time))
        requested = true;
    else if (signal != SIGXCPU && time - none > same_request)
        ::_exit(128 + signal);
}

}  // namespace

void handle_signals(OnSignal reaction) {
    at_once = reaction == OnSignal::end_at_once;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;  // a write to a file is not cut short by a polite request
    ::sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGXCPU}) ::sigaction(signal, &action, nullptr);
    struct sigaction before {};
    ::sigaction(SIGHUP, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

void ignore_write_signals() {
    for (const int signal : {SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_IGN);
}

bool interrupt_requested() {
    return requested.load();
}

StopSafely::StopSafely() : at_once_(at_once.exchange(false)) {}

StopSafely::~StopSafely() {
    at_once = at_once_;
}

}  // namespace grainfield::triaxial
