// The file of a checkpoint: whatever happened to it, it is refused with a reason, and the one
// before is taken.

#include "core/state/checkpoint_file.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/files/file_info.hpp"
#include "core/files/text_file.hpp"
#include "core/state/section_of.hpp"
#include "tests/files/sample.hpp"
#include "tests/reliability/record.hpp"

namespace grainfield::core {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class CheckpointFile : public FilesTest {
  protected:
    fs::path file() const { return in_folder("run.bin"); }
    /// Makes a checkpoint of one number.
    void save(int number) {
        Checkpoint checkpoint(file(), R"({"what":"a number"})", 0);
        const auto section =
            section_of(&checkpoint, "number", [&](auto& archive) { archive(number, text_); });
        checkpoint.save();
    }
    /// The number of the checkpoint that is found.
    int load(std::vector<std::string>* bad = nullptr) {
        auto found = find_checkpoint(file());
        EXPECT_TRUE(found);
        if (bad != nullptr) *bad = found->bad;
        EXPECT_EQ(nlohmann::json::parse(found->identity)["what"], "a number");
        Checkpoint checkpoint(file(), {}, 0);
        checkpoint.resume(*found);
        int number = 0;
        std::string text;
        const auto section =
            section_of(&checkpoint, "number", [&](auto& archive) { archive(number, text); });
        EXPECT_TRUE(section.resumed());
        EXPECT_FALSE(checkpoint.resuming());
        EXPECT_EQ(text, text_);
        return number;
    }
    /// Without waiting for the disk, thousands of times.
    void replace(const std::string& content) const {
        std::ofstream(file(), std::ios::binary) << content;
    }
    std::string text_ = "state";
};

TEST_F(CheckpointFile, KeepsTheOneBefore) {
    EXPECT_FALSE(find_checkpoint(file()));
    save(1);
    EXPECT_EQ(load(), 1);
    EXPECT_FALSE(fs::exists(file_before(file())));
    save(2);
    save(3);
    EXPECT_EQ(load(), 3);
    EXPECT_EQ(entries(), 2U);
    fs::remove(file());  // the moment between the two renames of a save
    EXPECT_EQ(load(), 2);
}

TEST_F(CheckpointFile, SaysWhatItIs) {
    save(1);
    const std::string info = describe_file(file());
    EXPECT_THAT(info, StartsWith("checkpoint, whole"));
    EXPECT_THAT(info, HasSubstr("  what: \"a number\"\n"));
    text_file("run.bin", "something else");
    EXPECT_THAT(message_of<FileError>([&] { describe_file(file()); }), HasSubstr("no checkpoint"));
}

TEST_F(CheckpointFile, IsRefusedAtEveryLength) {
    save(1);
    const std::string whole = read_whole_file(file());
    ASSERT_LT(whole.size(), 400U);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        replace(whole.substr(0, length));
        EXPECT_THAT(message_of<FileError>([&] { find_checkpoint(file()); }),
                    StartsWith(file().string() + ": is "))
            << length;
    }
    reliability::record("refusals",
                        {{"how", "cut, at every length"}, {"count", std::to_string(whole.size())}});
    text_file("run.bin", whole + '\0');
    EXPECT_THAT(message_of<FileError>([&] { find_checkpoint(file()); }), HasSubstr("length"));
}

TEST_F(CheckpointFile, IsRefusedWithAnyBitFlipped) {
    save(1);
    const std::string whole = read_whole_file(file());
    for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
        std::string flipped = whole;
        flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << bit % 8));
        replace(flipped);
        EXPECT_THAT(message_of<FileError>([&] { find_checkpoint(file()); }),
                    StartsWith(file().string() + ": is "))
            << bit;
    }
    reliability::record("refusals", {{"how", "every bit flipped, one at a time"},
                                     {"count", std::to_string(8 * whole.size())}});
}

TEST_F(CheckpointFile, ADamagedOneGivesWayToTheOneBefore) {
    save(1);
    save(2);
    std::string damaged = read_whole_file(file());
    damaged.back() = static_cast<char>(damaged.back() ^ 1);
    text_file("run.bin", damaged);
    std::vector<std::string> bad;
    EXPECT_EQ(load(&bad), 1);
    ASSERT_EQ(bad.size(), 1U);
    EXPECT_THAT(bad[0], HasSubstr("run.bin: is damaged: its checksum is wrong"));
    text_file("run.before.bin", "grainfield checkpoint 9\n");
    const std::string both = message_of<FileError>([&] { find_checkpoint(file()); });
    EXPECT_THAT(both, HasSubstr("run.bin: is damaged"));
    EXPECT_THAT(both, HasSubstr("run.before.bin: is a checkpoint of another version"));
}

TEST_F(CheckpointFile, PartsAreNestedAndNamed) {
    int outer = 1, inner = 2;
    const auto outer_state = [&](auto& archive) { archive(outer); };
    const auto inner_state = [&](auto& archive) { archive(inner); };
    {
        Checkpoint checkpoint(file(), {}, 0);
        const auto a = section_of(&checkpoint, "outer", outer_state);
        { const auto gone = section_of(&checkpoint, "gone", inner_state); }
        const auto b = section_of(&checkpoint, "inner", inner_state);
        checkpoint.save();
    }
    outer = inner = 0;
    Checkpoint checkpoint(file(), {}, 0);
    checkpoint.resume(*find_checkpoint(file()));
    const auto a = section_of(&checkpoint, "outer", outer_state);
    EXPECT_TRUE(a.resumed() && checkpoint.resuming());
    EXPECT_THAT(message_of<FileError>([&] { section_of(&checkpoint, "else", inner_state); }),
                HasSubstr("\"inner\" where that of \"else\" is expected"));
    EXPECT_EQ(outer, 1);
}

TEST_F(CheckpointFile, WhoHasNoPartLoadsNothing) {
    int number = 5;
    const auto state = [&](auto& archive) { archive(number); };
    const auto none = section_of(nullptr, "number", state);
    EXPECT_FALSE(none.resumed());
    Checkpoint checkpoint(file(), {}, 0);
    const auto fresh = section_of(&checkpoint, "number", state);
    EXPECT_FALSE(fresh.resumed());
    EXPECT_EQ(number, 5);
    checkpoint.save();
    checkpoint.remove();
    EXPECT_EQ(entries(), 0U);
}

TEST_F(CheckpointFile, IsDueAfterItsInterval) {
    Checkpoint never(file(), {}, 0), soon(file(), {}, 1e-9);
    int due = 0;
    for (int k = 0; k < 1600; ++k) {
        EXPECT_FALSE(never.due());
        due += soon.due() ? 1 : 0;
    }
    EXPECT_EQ(due, 100);  // it looks at the clock at every 16th call
}

}  // namespace
}  // namespace grainfield::core
