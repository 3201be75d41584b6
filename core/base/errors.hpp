#pragma once
// What can go wrong, by who has to act on it. Libraries throw these and never print or exit;
// the command line turns them into the exit codes of the contract (2, 3, 4, 130).

#include <stdexcept>
#include <string>

namespace grainfield {

/// Bad usage, config or input (exit code 2). The message names file, line, key, value and what is
/// allowed, as far as they are known where it is thrown.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The simulation failed: unstable, NaN, a sphere lost (exit code 3).
struct SimulationError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A file could not be read or written, or is corrupt (exit code 4).
struct FileError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Stopped by SIGINT or SIGTERM (exit code 130).
struct Interrupted : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace grainfield
