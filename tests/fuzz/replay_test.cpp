// Every file of the corpora, and thousands of ways to spoil each, through the readers.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/files/text_file.hpp"
#include "tests/fuzz/targets.hpp"

namespace grainfield::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> corpus(const std::string& name) {
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(fs::path(GRAINFIELD_SOURCE_DIR) / "tests/fuzz/corpus" / name))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::string> contents;
    for (const fs::path& file : files) contents.push_back(core::read_whole_file(file));
    return contents;
}

class Spoiler {
  public:
    explicit Spoiler(unsigned seed) : random_(seed) {}

    /// The text with one to four things wrong with it.
    std::string spoil(std::string text, const std::string& other) {
        for (int k = static_cast<int>(below(4)); k >= 0; --k) once(text, other);
        return text;
    }

  private:
    std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
    void once(std::string& text, const std::string& other) {
        static const char* const words[] = {
            "nan",        "-inf",     "1e999", "-1", "0",  "9223372036854775808",
            "\"",         "[",        "]]",    "=",  "\n", ",,",
            "1e-320",     "\xff\xfe", "'''",   "[[", "{",  "true",
            "1979-05-27", "0x7f",     "_",     ".",  "#",  "-0.0"};
        const std::size_t at = below(text.size() + 1);
        const std::size_t length = below(std::min<std::size_t>(text.size() - at, 40) + 1);
        switch (below(6)) {
            case 0:
                if (at < text.size()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
                break;
            case 1:
                text.erase(at, length);
                break;
            case 2:
                text.insert(at, text.substr(below(text.size() + 1), length));
                break;
            case 3:
                text.replace(at, length, words[below(std::size(words))]);
                break;
            case 4:
                text.insert(at, other.substr(below(other.size() + 1), 60));
                break;
            default:
                text.resize(at);
        }
    }
    std::mt19937 random_;
};

class Replay : public ::testing::TestWithParam<Target> {};

TEST_P(Replay, WhatIsRightIsTakenAndWhatIsWrongIsRefused) {
    const std::vector<std::string> files = corpus(GetParam().name);
    ASSERT_FALSE(files.empty());
    int taken = 0;
    for (const std::string& file : files) taken += GetParam().run(file) ? 1 : 0;
    EXPECT_GT(taken, 0) << "some of the corpus are valid files";
    Spoiler spoiler(7);
    int runs = 0, survived = 0;
    for (int round = 0; runs < GetParam().replays; ++round)
        for (const std::string& file : files) {
            survived += GetParam().run(spoiler.spoil(
                            file, files[static_cast<std::size_t>(round) % files.size()]))
                            ? 1
                            : 0;
            ++runs;
        }
    RecordProperty("spoilt", runs);
    RecordProperty("still_valid", survived);
    EXPECT_LT(survived, runs) << "nothing was refused";
}

INSTANTIATE_TEST_SUITE_P(Readers, Replay, ::testing::ValuesIn(targets),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace grainfield::fuzz
