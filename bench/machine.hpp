#pragma once
// What the machine can do: its name, and the bandwidth that the floor of a step is reckoned with.

#include <cstddef>
#include <string>

namespace grainfield::bench {

/// Name of the processor as the system gives it, fit for a file name.
std::string cpu_name();

/// Bandwidth of a[i] = b[i] + s c[i] on all threads of OpenMP over arrays of `bytes` in all, best
/// of several runs [B/s]; 24 B an element, as STREAM counts.
double triad_bandwidth(std::size_t bytes);

/// Memory that this process has allocated and not given back [B].
std::size_t bytes_in_use();

}  // namespace grainfield::bench
