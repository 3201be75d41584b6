#pragma once
// SIGINT, SIGTERM, SIGHUP and SIGXCPU: the first asks the work to stop at a safe place, another one
// half a second later ends it. What the system sends again and again (SIGXCPU) only asks.

namespace grainfield::triaxial {

enum class OnSignal {
    stop_safely,  ///< the first sets a flag that the work polls (Monitor::stop_requested)
    end_at_once   ///< while nothing is there to save: the first ends the program
};

/// Installs the handlers. The program ends with 130 where the first signal ends it, with 128 +
/// signal where another one does. A SIGHUP that is ignored (nohup) stays so.
void handle_signals(OnSignal reaction);

/// From here on writing to a closed pipe or beyond the limit of a file's size is an error of that
/// write, not the end of the program.
void ignore_write_signals();

/// True once a signal asked the work to stop.
bool interrupt_requested();

/// While it lives a signal only asks to stop, also where it would end the program at once: there
/// is something to take away first.
class StopSafely {
  public:
    StopSafely();
    ~StopSafely();
    StopSafely(const StopSafely&) = delete;
    StopSafely& operator=(const StopSafely&) = delete;

  private:
    bool at_once_;  // before
};

}  // namespace grainfield::triaxial
