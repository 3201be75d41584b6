#pragma once
// How much memory there is, so that what cannot fit is refused before it is begun.

namespace grainfield::core {

/// What this process may use: the machine's memory, or less where a limit is set (ulimit -v, the
/// control group of a container) [B].
double memory_of_process();

}  // namespace grainfield::core
