#pragma once
// Runs of the program in which one call on its files goes wrong (layer/fault_layer.cpp), and the
// count of what was tried.

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {

/// What goes wrong, as the layer names it.
inline const std::string fault_kinds[] = {"eio",       "enospc", "full",     "half",
                                          "half_full", "kill",   "half_kill"};
bool kills(const std::string& kind);

struct Fault {
    int at = 0;  ///< number of the call, from 1; 0: none, calls are only counted [-]
    std::string kind;
};

/// A call on a file below the folder under watch, as the layer noted it.
struct Call {
    int number = 0;
    std::string name, path;

    bool is(const std::string& call, const std::string& file) const;
    /// Of a temporary that write_file_atomically() fills.
    bool on_temporary() const;
};

/// True if a fault of this kind at this call is one of its own: half of a write needs a write, a
/// disk is full where there is something to store, a kill before a call that leaves the files as
/// they are comes to the same as one before the next. The lock goes last, when the run is over.
bool applies(const std::string& kind, const Call& call);

std::string in_words(const Fault& fault, const Call& call);

struct FaultyRun {
    Outcome outcome;
    std::vector<Call> calls;
};

/// Runs the program; calls on files below `folder` of the workplace count.
FaultyRun run_with_fault(const Workplace& place, const std::string& folder,
                         const std::vector<std::string>& arguments, const Fault& fault = {});

/// Number of the first call of which this is true, at `from` or later; a failure if there is none.
template <class True>
int first_call(const std::vector<Call>& calls, const True& is_it, int from = 1) {
    for (const Call& call : calls)
        if (call.number >= from && is_it(call)) return call.number;
    throw std::runtime_error("the run makes no such call");
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::string& more);

/// Makes `to` a copy of `from`, both folders of the workplace.
void copy_folder(const Workplace& place, const std::string& from, const std::string& to);
/// Names of the files in a folder of the workplace that are not among `expected`.
std::vector<std::string> others_in(const Workplace& place, const std::string& folder,
                                   const std::vector<std::string>& expected);

/// How many faults there were and how the runs ended; printed and recorded when a test is over.
class Tally {
  public:
    Tally(std::string what, int calls) : what_(std::move(what)), calls_(calls) {}
    ~Tally();
    Tally(const Tally&) = delete;
    Tally& operator=(const Tally&) = delete;

    /// The run with the fault must have ended as such a one may: done, with a message that names a
    /// file below `folder`, or killed.
    void ended(const Fault& fault, const Outcome& outcome, const std::string& folder);
    void resumed() { ++resumed_; }

  private:
    std::string what_;
    int calls_, resumed_ = 0;
    std::map<std::string, std::map<int, int>> ends_;  // by kind and exit code
};

}  // namespace grainfield::program_tests
