#pragma once
// Checkpoints: the whole state of a run, from which it goes on to the same bits.
//
// Work is nested: a command makes a packing, which settles a sample, in a loop. Each level that has
// state of its own declares a section of the checkpoint while it runs; a save writes all sections,
// outer ones first. A run that resumes takes the same way again: every section finds its state as
// it was, and the level skips what is done.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/state/bytes.hpp"

namespace grainfield::core {

class CheckpointReader;

/// A checkpoint of an earlier run, found whole.
struct FoundCheckpoint {
    std::filesystem::path file;
    std::string identity;          ///< what the run was, as its Checkpoint was told
    std::vector<std::string> bad;  ///< newer files that are damaged: name and reason
    std::shared_ptr<CheckpointReader> reader;
};

/// The checkpoint in one file. FileError where it is damaged or of another version of the program.
FoundCheckpoint open_checkpoint(const std::filesystem::path& file);

/// Looks for `file` and the one before it. Nothing where neither is there; FileError, naming both,
/// where what is there is damaged or of another version of the program.
std::optional<FoundCheckpoint> find_checkpoint(const std::filesystem::path& file);

class Checkpoint {
  public:
    using Clock = std::chrono::steady_clock;
    using Save = std::function<void(StateWriter&)>;
    using Load = std::function<void(StateReader&)>;

    /// Saves into `file` when told to; due() about every `interval` seconds, never if that is 0.
    /// `identity` says what the run is, as a
    /// JSON object, for whoever resumes it.
    Checkpoint(std::filesystem::path file, std::string identity, double interval);
    ~Checkpoint();
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    /// The sections declared from now on find the state of this checkpoint, as long as it has any.
    void resume(FoundCheckpoint found);
    bool resuming() const { return source_ != nullptr; }

    /// True if the interval has passed since the last save. Cheap: to be called at every step.
    bool due();
    /// Writes all sections beside `file`, flushes, keeps the file of before as file_before(), and
    /// takes its place. FileError; the last good one is still there then.
    void save();
    /// Removes the files: the run has its results.
    void remove();

    const std::filesystem::path& file() const { return file_; }
    std::int64_t saves() const { return saves_; }  ///< so far [-]

    /// State of one level of the work, for as long as this lives.
    class Section {
      public:
        /// Takes part in `checkpoint` (nullptr: in none); calls load() at once if the run resumes.
        /// Throws FileError if the checkpoint has another section here than `name`.
        Section(Checkpoint* checkpoint, std::string_view name, Save save, Load load);
        ~Section();
        Section(const Section&) = delete;
        Section& operator=(const Section&) = delete;

        bool resumed() const { return resumed_; }  ///< state was loaded

      private:
        Checkpoint* checkpoint_;
        bool resumed_ = false;
    };

  private:
    struct Level {
        std::string name;
        Save save;
    };
    std::filesystem::path file_;
    std::string identity_;
    double interval_;  // [s]
    std::vector<Level> levels_;
    std::shared_ptr<CheckpointReader> source_;  // while the run resumes
    Clock::time_point last_;
    int calls_ = 0;
    std::int64_t saves_ = 0;
};

/// Gives the checkpoint that another run left as `file` another name, x.bin -> x.stale.bin, so that
/// none but its own is taken for one of the run that begins. Returns that name; nothing where there
/// is none. Throws FileError.
std::optional<std::filesystem::path> put_checkpoint_away(const std::filesystem::path& file);

/// Where the checkpoint before the last is kept: x.bin -> x.before.bin.
std::filesystem::path file_before(const std::filesystem::path& file);

}  // namespace grainfield::core
