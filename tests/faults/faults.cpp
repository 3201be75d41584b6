#include "tests/faults/faults.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <sstream>

#include "tests/reliability/record.hpp"

namespace grainfield::program_tests {
namespace {

namespace fs = std::filesystem;

/// A variable of the environment for as long as this lives.
class Variable {
  public:
    Variable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        ::setenv(name, value.c_str(), 1);
    }
    ~Variable() {
        if (before_)
            ::setenv(name_, before_->c_str(), 1);
        else
            ::unsetenv(name_);
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

std::vector<Call> read_calls(const std::string& log) {
    std::vector<Call> calls;
    std::istringstream lines(log);
    for (Call call; lines >> call.number >> call.name && std::getline(lines >> std::ws, call.path);)
        calls.push_back(call);
    return calls;
}

}  // namespace

bool kills(const std::string& kind) {
    return kind == "kill" || kind == "half_kill";
}

bool Call::is(const std::string& call, const std::string& file) const {
    return name == call && path.ends_with(file);
}

bool Call::on_temporary() const {
    return path.find("/.grainfield-") != std::string::npos;
}

bool applies(const std::string& kind, const Call& call) {
    const bool writes = call.name.find("write") != std::string::npos;
    if (kind.starts_with("half") || kind == "full") return writes;
    if (kind == "enospc") return writes || call.name == "fsync";
    if (kind == "kill")
        return call.name != "close" && call.name != "fsync" &&
               !call.is("remove", "checkpoint.lock");
    return true;
}

std::string in_words(const Fault& fault, const Call& call) {
    return fault.kind + " at " + std::to_string(call.number) + ": " + call.name + " " + call.path;
}

FaultyRun run_with_fault(const Workplace& place, const std::string& folder,
                         const std::vector<std::string>& arguments, const Fault& fault) {
    fs::remove(place.path("calls.txt"));
    const Variable variables[] = {{"LD_PRELOAD", GRAINFIELD_FAULT_LAYER},
                                  {"GRAINFIELD_FAULT_FOLDER", place.path(folder)},
                                  {"GRAINFIELD_FAULT_AT", std::to_string(fault.at)},
                                  {"GRAINFIELD_FAULT_KIND", fault.kind},
                                  {"GRAINFIELD_FAULT_LOG", place.path("calls.txt")}};
    FaultyRun run;
    run.outcome = place.run(arguments);
    run.calls = read_calls(place.read("calls.txt"));
    // Without this a layer that was not loaded would let every test pass.
    EXPECT_GE(static_cast<int>(run.calls.size()), std::max(1, fault.at)) << run.outcome.err;
    return run;
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::string& more) {
    arguments.push_back(more);
    return arguments;
}

void copy_folder(const Workplace& place, const std::string& from, const std::string& to) {
    fs::remove_all(place.path(to));
    fs::copy(place.path(from), place.path(to));
}

std::vector<std::string> others_in(const Workplace& place, const std::string& folder,
                                   const std::vector<std::string>& expected) {
    std::vector<std::string> others;
    for (const auto& entry : fs::directory_iterator(place.path(folder))) {
        const std::string name = entry.path().filename();
        if (std::find(expected.begin(), expected.end(), name) == expected.end())
            others.push_back(name);
    }
    return others;
}

void Tally::ended(const Fault& fault, const Outcome& outcome, const std::string& folder) {
    ++ends_[fault.kind][outcome.code];
    if (kills(fault.kind)) {
        EXPECT_EQ(outcome.code, 128 + SIGKILL) << outcome.err;
        return;
    }
    EXPECT_THAT(outcome.code, testing::AnyOf(0, 4)) << outcome.err;
    if (outcome.code == 4) {
        EXPECT_THAT(outcome.err, testing::HasSubstr("grainfield: " + folder)) << "names no file";
    }
}

Tally::~Tally() {
    std::ostringstream text;
    int all = 0;
    for (const auto& [kind, ends] : ends_)
        for (const auto& [code, count] : ends)
            reliability::record("faults", {{"run", what_},
                                           {"calls", std::to_string(calls_)},
                                           {"kind", kind},
                                           {"code", std::to_string(code)},
                                           {"count", std::to_string(count)}});
    reliability::record("resumed", {{"run", what_}, {"count", std::to_string(resumed_)}});
    for (const auto& [kind, ends] : ends_) {
        text << "; " << kind << ":";
        int injected = 0;
        for (const auto& [code, count] : ends) {
            text << (injected > 0 ? ", " : " ") << count << " ended " << code;
            injected += count;
        }
        all += injected;
        testing::Test::RecordProperty(kind + " in " + what_, injected);
    }
    testing::Test::RecordProperty("calls of " + what_, calls_);
    testing::Test::RecordProperty("resumed after " + what_, resumed_);
    std::cout << "[ faults   ] " << what_ << ": " << all << " faults in a run of " << calls_
              << " calls, " << resumed_ << " resumed" << text.str() << '\n';
}

}  // namespace grainfield::program_tests
