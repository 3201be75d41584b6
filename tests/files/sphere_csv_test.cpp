#include <gmock/gmock.h>

#include <chrono>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "tests/files/sample.hpp"

namespace grainfield::core {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
class SphereCsvTest : public FilesTest {
  protected:
    SphereFile read(const std::string& text) const {
        return read_spheres(text_file("s.csv", text));
    }

    /// The error for this text, without the folder in front of the file's name.
    std::string error(const std::string& text) const {
        const std::string message = message_of<InputError>([&] { read(text); });
        EXPECT_THAT(message, StartsWith(in_folder("s.csv").string()));
        return message.substr(message.find("s.csv"));
    }
};

const std::string required = "x,y,z,radius\n";

TEST_F(SphereCsvTest, KeepsEveryBit) {
    const SphereFile sample = make_sample(500);
    write_spheres(in_folder("s.csv"), sample);
    const SphereFile back = read_spheres(in_folder("s.csv"));
    expect_same_columns(back.spheres, sample.spheres);
    EXPECT_TRUE(back.has_normal_stiffness && back.has_friction_angle);
    EXPECT_TRUE(back.has_velocity && back.has_block);
    EXPECT_FALSE(back.box);
    EXPECT_EQ(back.spheres.mass, Column<double>(500, 0.0)) << "a .csv knows no masses";
    EXPECT_EQ(back.lines.front(), 2);
    EXPECT_EQ(back.lines.back(), 501);
}

TEST_F(SphereCsvTest, WritesOnlyTheColumnsThatAreThere) {
    SphereFile sample = make_sample(1);
    sample.spheres.position.set(0, {0.1, -2, 1e-7});
    sample.spheres.radius[0] = 0.005;
    sample.spheres.friction_angle[0] = 0.6;
    sample.has_normal_stiffness = sample.has_velocity = sample.has_block = false;
    write_spheres(in_folder("s.csv"), sample);
    EXPECT_EQ(read_whole_file(in_folder("s.csv")),
              "x,y,z,radius,friction_angle\n0.1,-2,1e-07,0.005,0.6\n");
}

TEST_F(SphereCsvTest, ReadsColumnsByName) {
    const SphereFile file = read(
        "# made by hand\r\n\r\nx,y,z,radius, block_k,block_i,block_j,wx,wy,wz\r\n"
        "1,2,3,.5,7,-1,+6,10,11,12\r\n  # between\r\n4, 5 ,6,1e-1,0,1,2,0,0,-3\r\n");
    ASSERT_EQ(file.spheres.size(), 2u);
    EXPECT_EQ(file.spheres.position[1], Vec3(4, 5, 6));
    EXPECT_EQ(file.spheres.radius[1], 0.1);
    EXPECT_EQ(file.spheres.block[0], (BlockIndex{-1, 6, 7}));
    EXPECT_EQ(file.spheres.spin[0], Vec3(10, 11, 12));
    EXPECT_EQ(file.spheres.velocity[0], Vec3(0, 0, 0));
    EXPECT_TRUE(file.has_velocity && file.has_block);
    EXPECT_FALSE(file.has_normal_stiffness || file.has_friction_angle);
    EXPECT_EQ(file.lines, (std::vector<std::int32_t>{4, 6}));
}

TEST_F(SphereCsvTest, TakesATextWithoutLastLineEndAndWithByteOrderMark) {
    EXPECT_EQ(read("\xEF\xBB\xBF" + required + "1,2,3,4").spheres.size(), 1u);
    EXPECT_EQ(read(required).spheres.size(), 0u);
}

TEST_F(SphereCsvTest, NamesLineColumnValueAndWhatIsAllowed) {
    const std::string one = "0,0,0,1\n";
    EXPECT_EQ(error(required + one + "0,0,0,-0.1\n"),
              "s.csv:3: column radius = -0.1: must be > 0 m");
    EXPECT_EQ(error(required + "0,0,0,0\n"), "s.csv:2: column radius = 0: must be > 0 m");
    for (const char* bad :
         {"nan", "-nan", "inf", "-inf", "1e999", "abc", "0x10", "1 2", "++1", "+-1"})
        EXPECT_EQ(error(required + one + "\n0," + bad + ",0,1\n"),
                  std::string("s.csv:4: column y = ") + bad + ": must be a finite number [m]");
    EXPECT_EQ(error(required + "0,,0,1\n"),
              "s.csv:2: column y = (nothing): must be a finite number [m]");
    EXPECT_EQ(error("x,y,z,radius,normal_stiffness\n0,0,0,1,0\n"),
              "s.csv:2: column normal_stiffness = 0: must be > 0 Pa");
    for (const char* bad : {"-0.1", "1.5708", "90"})
        EXPECT_EQ(error(std::string("x,y,z,radius,friction_angle\n0,0,0,1,") + bad),
                  std::string("s.csv:2: column friction_angle = ") + bad +
                      ": must be >= 0 and < pi/2 rad");
    for (const char* bad : {"-2", "1.0", "2147483648"})
        EXPECT_EQ(
            error(std::string("x,y,z,radius,block_i,block_j,block_k\n0,0,0,1,0,") + bad + ",0"),
            std::string("s.csv:2: column block_j = ") + bad +
                ": must be an integer >= 0, or -1 for none");
}

TEST_F(SphereCsvTest, NamesWrongNumbersOfFields) {
    EXPECT_EQ(error(required + "0,0,1\n"), "s.csv:2: 3 fields, but the header has 4");
    EXPECT_EQ(error(required + "0,0,0,1,\n"), "s.csv:2: 5 fields, but the header has 4");
    EXPECT_EQ(
        error(required + "0 0 0 1\n"),
        "s.csv:2: 1 fields, but the header has 4; blanks stand in it: fields must be separated "
        "by commas");
}

TEST_F(SphereCsvTest, NamesWrongHeaders) {
    for (const char* empty : {"", "\n\n", "# only a comment\n"})
        EXPECT_THAT(error(empty), StartsWith("s.csv:1: no header; required: x,y,z,radius"));
    EXPECT_THAT(error("x,y,z,r\n"),
                StartsWith("s.csv:1: column 'r' is unknown; required: x,y,z,ra"));
    EXPECT_THAT(error("x,y,z,radius,\n"), HasSubstr("column '' is unknown"));
    EXPECT_THAT(error("1,2,3,4\n"), HasSubstr("column '1' is unknown"));
    EXPECT_THAT(error("x,y,z,radius,colour\n"),
                HasSubstr("optional: normal_stiffness,friction_angle,vx,vy,vz,wx,wy,wz,block_i"));
    EXPECT_EQ(error("x,y,z,radius,y\n"), "s.csv:1: column y stands twice");
    EXPECT_EQ(error("# c\nx,z,radius\n"), "s.csv:2: column y is missing; required: x,y,z,radius");
    EXPECT_EQ(error("x,y,z,radius,vx,vz\n"),
              "s.csv:1: column vy is missing; its sister columns are there");
}

TEST_F(SphereCsvTest, RefusesBinaryContent) {
    std::string noise(4096, '\0');
    for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<char>(i * 131 + i / 7);
    EXPECT_THROW(read(noise), InputError);
}

TEST_F(SphereCsvTest, ReadsAFullSampleFast) {
    const SphereFile sample = make_sample(151632);
    const auto start = std::chrono::steady_clock::now();
    write_spheres(in_folder("s.csv"), sample);
    const auto written = std::chrono::steady_clock::now();
    const SphereFile back = read_spheres(in_folder("s.csv"));
    const auto read = std::chrono::steady_clock::now();
    expect_same_columns(back.spheres, sample.spheres);
    const std::chrono::duration<double> writing = written - start;
    const std::chrono::duration<double> reading = read - written;
    RecordProperty("write_ms", static_cast<int>(1e3 * writing.count()));
    RecordProperty("read_ms", static_cast<int>(1e3 * reading.count()));
    // Takes some 0.3 s in Release. Ten times that: sanitizers and busy machines, not O(N^2).
    EXPECT_LT(reading.count(), 3.0);
}

}  // namespace
}  // namespace grainfield::core
