#pragma once
// A check that is also a row of tests/VERIFICATION.md: what a case should give by its closed form,
// what came out, and how far apart they may be. Any test program may record.

#include <string>

namespace grainfield::verify {

/// What a row of the page says before any number. The first two name the row.
struct Case {
    /// Folder below tests/verification/scenes, or the heading of tests that have no scene.
    std::string scene = {};
    std::string quantity = {};     ///< what is compared, such as "contact time"
    std::string closed_form = {};  ///< the expected value as a formula
    std::string source = {};       ///< who says so: author and year, or the derivation's idea
    std::string unit = {};         ///< of the values, SI; empty for a pure number
    std::string tolerance = {};    ///< why the tolerance is as wide as it is
    /// Errors are shown over this; 0: over the expected value, or as they are where that is 0.
    double scale = 0;
};

/// Fails the test, at the caller's line, unless |computed - expected| <= tolerance, all in the
/// case's unit, and unless the committed page has the case's row. Where the environment variable
/// GRAINFIELD_VERIFICATION names a folder, the test's records are written there instead of being
/// looked up, as one JSON file a test.
/// `kernel` is the name of a KernelCase (or SolverCase), or "any" where the kernels play no part.
void record(const Case& row, const std::string& kernel, double expected, double computed,
            double tolerance, const char* file = __builtin_FILE(), int line = __builtin_LINE());

}  // namespace grainfield::verify
