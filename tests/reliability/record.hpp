#pragma once
// What a test counted, for tests/RELIABILITY.md: how many faults there were, where a run was
// stopped and resumed. `./dev reliability` gathers it; any other test run throws it away.

#include <string>
#include <utility>
#include <vector>

namespace grainfield::reliability {

/// Where the environment variable GRAINFIELD_RELIABILITY names a folder, adds a line to its file
/// `kind`.jsonl: an object of the test's name and these values.
void record(const std::string& kind,
            const std::vector<std::pair<std::string, std::string>>& values);

/// "yes" or "no".
inline std::string same(const std::string& a, const std::string& b) {
    return a == b ? "yes" : "no";
}

}  // namespace grainfield::reliability
