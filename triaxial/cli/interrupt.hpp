#pragma once
// SIGINT and SIGTERM: the first asks the work to stop at a safe place, another one half a second
// later ends it.

namespace grainfield::triaxial {

enum class OnSignal {
    stop_safely,  ///< the first sets a flag that the work polls (Monitor::stop_requested)
    end_at_once   ///< for commands that are quick or cannot be asked: the first ends the program
};

/// Installs the handlers. The program ends with 128 + signal where it ends at once.
void handle_signals(OnSignal reaction);

/// True once a signal asked the work to stop.
bool interrupt_requested();

}  // namespace grainfield::triaxial
