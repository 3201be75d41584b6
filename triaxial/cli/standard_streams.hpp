#pragma once
// The program's own three streams, which may be closed, full or gone: a log that cannot be written
// never ends a run, a result that cannot be written is said by the exit code.

#include <string_view>

namespace grainfield::triaxial {

/// Opens /dev/null in place of whichever of descriptors 0, 1 and 2 are closed. To be called before
/// any file is opened: one that became descriptor 2 would get the messages.
void open_standard_streams();

/// To stderr. An error of writing is ignored: there is nowhere left to say so.
void write_log(std::string_view text);

/// To stdout, where it waits in a buffer. Throws FileError where it cannot be written.
void write_result(std::string_view text);
/// Writes what still waits. Throws FileError.
void flush_results();

}  // namespace grainfield::triaxial
