#include "core/state/checkpoint.hpp"

#include <fmt/format.h>

#include <cereal/archives/binary.hpp>
#include <cereal/types/string.hpp>
#include <utility>

#include "core/base/errors.hpp"
#include "core/state/checkpoint_file.hpp"

namespace grainfield::core {
namespace fs = std::filesystem;

FoundCheckpoint open_checkpoint(const fs::path& file) {
    FoundCheckpoint found{file, {}, {}, std::make_shared<CheckpointReader>(file)};
    std::string version;
    StateReader archive(found.reader->stream());
    archive(version, found.identity);
    if (version != GRAINFIELD_VERSION)
        throw FileError(fmt::format("{}: is a checkpoint of version {}; this is {}", file.string(),
                                    version, GRAINFIELD_VERSION));
    return found;
}

namespace {

fs::path with_word(const fs::path& file, const char* word) {
    fs::path name = file;
    name.replace_extension();
    return (name += word) += file.extension();
}

fs::path stale_file(const fs::path& file) {
    return with_word(file, ".stale");
}

}  // namespace

fs::path file_before(const fs::path& file) {
    return with_word(file, ".before");
}

std::optional<fs::path> put_checkpoint_away(const fs::path& file) {
    std::optional<fs::path> stale;
    // The older one first: the last one takes its place.
    for (const fs::path& found : {file_before(file), file}) {
        if (!fs::exists(found)) continue;
        stale = stale_file(file);
        std::error_code error;
        fs::rename(found, *stale, error);
        if (error)
            throw FileError(fmt::format("{}: cannot be put away as {}: {}", found.string(),
                                        stale->string(), error.message()));
    }
    return stale;
}

std::optional<FoundCheckpoint> find_checkpoint(const fs::path& file) {
    std::vector<std::string> bad;
    for (const fs::path& candidate : {file, file_before(file)}) {
        if (!fs::exists(candidate)) continue;
        try {
            FoundCheckpoint found = open_checkpoint(candidate);
            found.bad = bad;
            return found;
        } catch (const FileError& error) {
            bad.emplace_back(error.what());
        }
    }
    if (bad.empty()) return std::nullopt;
    throw FileError(bad.size() == 1 ? bad[0] : fmt::format("{}; {}", bad[0], bad[1]));
}

Checkpoint::Checkpoint(fs::path file, std::string identity, double interval)
    : file_(std::move(file)),
      identity_(std::move(identity)),
      interval_(interval),
      last_(Clock::now()) {}

Checkpoint::~Checkpoint() = default;

void Checkpoint::resume(FoundCheckpoint found) {
    source_ = std::move(found.reader);
    if (source_->at_end()) source_.reset();
}

bool Checkpoint::due() {
    constexpr int calls_a_look = 16;  // the clock costs as much as a step of a few spheres
    if (interval_ <= 0 || ++calls_ < calls_a_look) return false;
    calls_ = 0;
    return std::chrono::duration<double>(Clock::now() - last_).count() >= interval_;
}

void Checkpoint::save() {
    last_ = Clock::now();  // one that fails is not tried again at once
    write_checkpoint_file(file_, file_before(file_), [&](std::ostream& stream) {
        StateWriter archive(stream);
        archive(std::string(GRAINFIELD_VERSION), identity_);
        for (const Level& level : levels_) {
            archive(level.name);
            level.save(archive);
        }
    });
    ++saves_;
    last_ = Clock::now();
}

void Checkpoint::remove() {
    std::error_code ignored;  // what cannot be removed is in nobody's way
    // The last one last: a run that is killed here can still be resumed.
    for (const fs::path& file :
         {unfinished_file(file_), stale_file(file_), file_before(file_), file_})
        fs::remove(file, ignored);
}

Checkpoint::Section::Section(Checkpoint* checkpoint, std::string_view name, Save save, Load load)
    : checkpoint_(checkpoint) {
    if (checkpoint_ == nullptr) return;
    if (checkpoint_->resuming()) {
        CheckpointReader& source = *checkpoint_->source_;
        StateReader archive(source.stream());
        std::string found;
        archive(found);
        if (found != name)
            throw FileError(
                fmt::format("{}: holds the state of \"{}\" where that of \"{}\" is "
                            "expected: it is of another run",
                            checkpoint_->file_.string(), found, name));
        load(archive);
        resumed_ = true;
        if (source.at_end()) checkpoint_->source_.reset();
    }
    checkpoint_->levels_.push_back({std::string(name), std::move(save)});
}

Checkpoint::Section::~Section() {
    if (checkpoint_ != nullptr) checkpoint_->levels_.pop_back();
}

}  // namespace grainfield::core
