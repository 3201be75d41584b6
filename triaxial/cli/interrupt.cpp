#include "triaxial/cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace grainfield::triaxial {
namespace {

// All that a handler touches: lock-free, hence safe to touch there.
std::atomic<bool> requested{false};
std::atomic<bool> at_once{false};
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void on_signal(int signal) {
    if (at_once.load() || requested.exchange(true)) ::_exit(128 + signal);
}

}  // namespace

void handle_signals(OnSignal reaction) {
    at_once = reaction == OnSignal::end_at_once;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;  // a write to a file is not cut short by a polite request
    ::sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) ::sigaction(signal, &action, nullptr);
}

bool interrupt_requested() {
    return requested.load();
}

}  // namespace grainfield::triaxial
