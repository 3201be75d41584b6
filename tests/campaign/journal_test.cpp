// Rows survive in the journal bit for bit; what a kill leaves behind is passed over; damage is
// found, at every byte.

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "core/files/text_file.hpp"
#include "tests/config/config_fixture.hpp"
#include "triaxial/campaign/journal.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;

Row some_row(std::int64_t k) {
    return {"cov=0.8", k,       0xffffffffffffffff,           false,
            1e5 / 3,   2e7 / 7, 0.1 * static_cast<double>(k), 0.01,
            5000 + k,  1.25,    "0123456789abcdef",           "peak",
            "asked",   ""};
}

class JournalTest : public ConfigTest {
  protected:
    std::filesystem::path file_ = folder_ / "rows.journal";
};

TEST_F(JournalTest, RowsComeBackBitForBit) {
    std::vector<Row> rows{some_row(0), some_row(1)};
    rows[1].failed = true;
    rows[1].reason = "sphere 3: \"lost\"\nat step 7, \\ \xc3\xa4";
    { Journal(file_).append(rows); }
    { Journal(file_).append({{some_row(2)}}); }
    rows.push_back(some_row(2));
    EXPECT_EQ(read_journal(file_), rows);
    EXPECT_TRUE(read_journal(folder_ / "none.journal").empty());
}

TEST_F(JournalTest, ARowCutShortAnywhereIsPassedOverAndWrittenOver) {
    { Journal(file_).append({{some_row(0), some_row(1)}}); }
    const std::string whole = core::read_whole_file(file_);
    const std::size_t first = whole.find('\n') + 1;
    for (std::size_t length = first; length < whole.size(); ++length) {
        write("rows.journal", whole.substr(0, length));
        ASSERT_EQ(read_journal(file_), std::vector<Row>{some_row(0)}) << length;
        { Journal(file_).append({{some_row(2)}}); }
        ASSERT_EQ(read_journal(file_), (std::vector<Row>{some_row(0), some_row(2)})) << length;
    }
}

TEST_F(JournalTest, EveryFlippedBitOfAWholeRowIsFound) {
    { Journal(file_).append({{some_row(0), some_row(1)}}); }
    const std::string whole = core::read_whole_file(file_);
    for (std::size_t at = 0; at < whole.find('\n'); ++at)
        for (int bit = 0; bit < 8; ++bit) {
            std::string damaged = whole;
            damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
            write("rows.journal", damaged);
            ASSERT_THROW(read_journal(file_), FileError) << at << ' ' << bit;
        }
    write("rows.journal", "x" + whole);
    EXPECT_THAT(message_of<FileError>([&] { read_journal(file_); }), HasSubstr("rows.journal:1"));
}

/// No more than so many bytes in a file, as long as it lives: a disk that is full.
class FullDisk {
  public:
    explicit FullDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

  private:
    rlimit before_{};
    void (*handler_)(int);
};

TEST_F(JournalTest, AFullDiskIsSaidAndLosesNoFinishedRow) {
    Journal journal(file_);
    journal.append({{some_row(0)}});
    const auto size = std::filesystem::file_size(file_);
    for (const std::uintmax_t room : {std::uintmax_t{0}, std::uintmax_t{1}, size / 2, size - 1}) {
        {
            const FullDisk disk(size + room);
            EXPECT_THAT(message_of<FileError>([&] { journal.append({{some_row(1)}}); }),
                        HasSubstr("rows.journal"));
        }
        EXPECT_EQ(std::filesystem::file_size(file_), size) << room;
        EXPECT_EQ(read_journal(file_), std::vector<Row>{some_row(0)});
    }
    journal.append({{some_row(1)}});
    EXPECT_EQ(read_journal(file_).size(), 2u);
    EXPECT_THROW(Journal(folder_ / "no" / "rows.journal"), FileError);
}

/// Journals of versions that did not say how a test ended.
TEST(Rows, OfEarlierVersionsAreRead) {
    std::string line = row_line(some_row(3));
    for (const std::string key : {"\"failure\":\"peak\",", "\"end_reason\":\"asked\","}) {
        ASSERT_NE(line.find(key), std::string::npos) << line;
        line.erase(line.find(key), key.size());
    }
    Row row;
    ASSERT_TRUE(parse_row(line, row));
    Row expected = some_row(3);
    expected.failure = expected.end_reason = "";
    EXPECT_EQ(row, expected);
}

TEST(Rows, StandInTheTableOfTheContract) {
    std::vector<Row> rows{some_row(2), some_row(10)};
    rows[1].failed = true;
    EXPECT_EQ(rows_csv(rows),
              "case,realization,seed,status,peak_deviator_stress_Pa,E50_Pa,friction_angle_rad,"
              "axial_strain_at_peak,steps,wall_seconds,state_hash,failure,end_reason\n"
              "cov=0.8,2,18446744073709551615,done,33333.333333333336,2857142.8571428573,0.2,0.01,"
              "5002,1.25,0123456789abcdef,peak,asked\n"
              "cov=0.8,10,18446744073709551615,failed,,,,,,1.25,,,\n");
    EXPECT_TRUE(row_before(rows[0], rows[1]));
}

}  // namespace
}  // namespace grainfield::triaxial
