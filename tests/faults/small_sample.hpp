#pragma once
// A packing of 120 spheres and a test on it, each a second's work; nothing of it is meant to be
// soil.

#include <string>
#include <vector>

#include "tests/faults/faults.hpp"

namespace grainfield::program_tests {

/// A subcommand on the small sample: an undisturbed run of it, and what killed ones leave.
class SmallRun {
  public:
    /// Runs `words`, with the sample's options, and its results into "run", which `target` names.
    SmallRun(const std::string& subcommand, const std::string& target,
             const std::vector<std::string>& more = {});

    /// Leaves in "killed" what a run that is killed at this call leaves.
    void kill_at(int call) const;
    /// `--resume` of what is in "killed".
    FaultyRun resume(const Fault& fault = {}) const;
    /// `--resume` of what the run before left, which must go on from a checkpoint.
    void resume_in_peace() const;

    Workplace place;
    FaultyRun undisturbed;  ///< its results are in "whole"

  private:
    std::vector<std::string> command_;
};

/// Number of the call that gave the last checkpoint its name.
int last_save(const std::vector<Call>& calls);

}  // namespace grainfield::program_tests
