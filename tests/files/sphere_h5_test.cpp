#include <gmock/gmock.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/files/hdf5_reader.hpp"
#include "core/files/hdf5_writer.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"
#include "tests/files/sample.hpp"
#include "tests/fuzz/made_h5.hpp"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/lsan_interface.h>
/// HDF5 1.10 forgets the header of an object whose checksum is wrong. That is its leak, not ours.
class LeaksOfHdf5 {
  public:
    LeaksOfHdf5() { H5garbage_collect(); }  // lest it forgets memory from before, used again

  private:
    __lsan::ScopedDisabler disabler_;
};
#else
struct LeaksOfHdf5 {};
#endif

namespace grainfield::core {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
class SphereH5Test : public FilesTest {
  protected:
    std::string error(const std::string& image) const {
        const auto path = text_file("bad.h5", image);
        const std::string message = message_of<FileError>([&] { read_spheres(path); });
        EXPECT_THAT(message, StartsWith(path.string() + ": "));
        return message.substr(path.string().size() + 2);
    }
};

SphereFile full_sample(std::size_t n) {
    SphereFile file = make_sample(n);
    file.kind = "packing";
    file.attributes = json_text({{"porosity", 0.1 + 0.2}, {"seed", 42}, {"name", "grüße \"x\"\n"}});
    file.extra["contacts"] = {{3, 2}, {0, 1, 1, 2, 2147483647, -6}};
    file.extra["shear_force"] = {{2}, {std::nextafter(1.0, 2.0), -0.0}};
    file.extra["nothing"] = {{0, 3}, {}};
    return file;
}

void expect_same(const SphereFile& a, const SphereFile& b) {
    expect_same_columns(a.spheres, b.spheres);
    EXPECT_TRUE(same_bits(a.spheres.mass, b.spheres.mass));
    ASSERT_EQ(a.box.has_value(), b.box.has_value());
    if (a.box) {
        EXPECT_EQ(a.box->lower, b.box->lower);
        EXPECT_EQ(a.box->upper, b.box->upper);
    }
    EXPECT_EQ(a.has_normal_stiffness, b.has_normal_stiffness);
    EXPECT_EQ(a.has_friction_angle, b.has_friction_angle);
    EXPECT_EQ(a.has_velocity, b.has_velocity);
    EXPECT_EQ(a.has_block, b.has_block);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.attributes, b.attributes);
    EXPECT_EQ(a.extra, b.extra);
}

TEST_F(SphereH5Test, KeepsEverythingBitForBit) {
    for (std::size_t n : {0, 1, 2, 351, 70000}) {
        const SphereFile sample = full_sample(n);
        write_spheres(in_folder("s.h5"), sample);
        const SphereFile back = read_spheres(in_folder("s.h5"));
        expect_same(back, sample);
        EXPECT_THAT(back.producer, StartsWith("grainfield"));
    }
}

TEST_F(SphereH5Test, KeepsColumnsWithoutFlagsAndNumbersThatAreNone) {
    SphereFile sample = make_sample(10);
    sample.has_velocity = sample.has_block = false;
    sample.has_normal_stiffness = sample.has_friction_angle = false;
    sample.box.reset();
    sample.spheres.position.x[3] = std::numeric_limits<double>::quiet_NaN();
    sample.spheres.velocity.z[4] = -std::numeric_limits<double>::infinity();
    write_spheres(in_folder("s.h5"), sample);
    expect_same(read_spheres(in_folder("s.h5")), sample);
}

TEST_F(SphereH5Test, KeepsLongAttributes) {
    SphereFile sample = make_sample(2);
    sample.attributes =
        json_text({{"config", std::string(200000, 'c')}});  // HDF5's old limit was 64 KiB
    write_spheres(in_folder("s.h5"), sample);
    expect_same(read_spheres(in_folder("s.h5")), sample);
}

TEST_F(SphereH5Test, EqualContentGivesEqualBytes) {
    const std::string once = format_sphere_h5(full_sample(1000));
    EXPECT_EQ(once, format_sphere_h5(full_sample(1000)));
}

TEST_F(SphereH5Test, RefusesAnExtraArrayThatDoesNotFillItsShape) {
    SphereFile sample = make_sample(2);
    sample.extra["a"] = {{2, 2}, {1, 2, 3}};
    EXPECT_THROW(write_spheres(in_folder("s.h5"), sample), std::invalid_argument);
    EXPECT_EQ(entries(), 0u);
}

TEST_F(SphereH5Test, NamesWhatIsNoHdf5File) {
    EXPECT_EQ(error(""), "not an HDF5 file");
    EXPECT_EQ(error("x,y,z,radius\n0,0,0,1\n"), "not an HDF5 file");
    EXPECT_EQ(error(std::string(5000, '\0')), "not an HDF5 file");
    const auto missing = in_folder("no.h5");
    EXPECT_EQ(message_of<FileError>([&] { read_spheres(missing); }),
              missing.string() + ": cannot be read: No such file or directory");
}

TEST_F(SphereH5Test, RefusesATruncatedFile) {
    const std::string image = format_sphere_h5(full_sample(300));
    for (std::size_t length :
         {std::size_t{1}, std::size_t{8}, std::size_t{9}, std::size_t{48}, std::size_t{96},
          std::size_t{2048}, image.size() / 2, image.size() - 512, image.size() - 1})
        EXPECT_FALSE(error(image.substr(0, length)).empty()) << length;
    EXPECT_THAT(error(image.substr(0, image.size() / 2)),
                StartsWith("damaged HDF5 file: truncated file"));
}

TEST_F(SphereH5Test, NeverTakesAFlippedBitForData) {
    [[maybe_unused]] const LeaksOfHdf5 tolerated{};
    const SphereFile sample = full_sample(40);
    const std::string image = format_sphere_h5(sample);
    std::size_t refused = 0;
    std::size_t tried = 0;
    for (std::size_t at = 0; at < image.size(); at += 5, ++tried) {
        std::string bad = image;
        bad[at] = static_cast<char>(bad[at] ^ (1 << at % 8));
        try {
            expect_same(parse_sphere_h5(bad, "bad.h5"), sample);  // a byte that nobody uses
        } catch (const FileError&) {
            ++refused;
        }
        if (HasFailure()) FAIL() << "wrong data taken, byte " << at << " of " << image.size();
    }
    EXPECT_GT(refused, tried / 4);
}

/// A well-formed file with one dataset left out or replaced.
std::string incomplete_image(const std::string& left_out, std::size_t points) {
    const SphereFile sample = make_sample(2);
    const std::string whole = format_sphere_h5(sample);
    const Hdf5Reader reader(whole, "whole");
    Hdf5Writer writer;
    for (const char* group : {"/VTKHDF", "/VTKHDF/PointData", "/grainfield"}) writer.group(group);
    const std::int64_t one = 1;
    writer.attribute("/grainfield", "format_version", std::span(&one, 1));
    for (const char* name : {"producer", "kind", "attributes"})
        writer.attribute("/grainfield", name, reader.text_attribute("/grainfield", name));
    for (const char* flag :
         {"has_normal_stiffness", "has_friction_angle", "has_velocity", "has_block"})
        writer.attribute("/grainfield", flag, std::span(&one, 1));
    const auto count = static_cast<std::int64_t>(points);
    writer.dataset<std::int64_t>("/VTKHDF/NumberOfPoints", {1}, std::span(&count, 1));
    for (const char* name :
         {"/VTKHDF/Points", "/VTKHDF/PointData/radius", "/VTKHDF/PointData/mass",
          "/VTKHDF/PointData/normal_stiffness", "/VTKHDF/PointData/friction_angle",
          "/VTKHDF/PointData/velocity", "/VTKHDF/PointData/spin"})
        if (name != left_out)
            writer.dataset<double>(name, reader.shape(name), reader.read<double>(name));
    if (left_out != "/VTKHDF/PointData/block")
        writer.dataset<std::int32_t>("/VTKHDF/PointData/block", {2, 3},
                                     std::vector<std::int32_t>(6));
    return writer.finish();
}

TEST_F(SphereH5Test, NamesTheDatasetThatIsMissing) {
    EXPECT_EQ(read_spheres(text_file("s.h5", incomplete_image("", 2))).spheres.size(), 2u);
    for (const std::string name :
         {"/VTKHDF/Points", "/VTKHDF/PointData/radius", "/VTKHDF/PointData/mass",
          "/VTKHDF/PointData/spin", "/VTKHDF/PointData/block"})
        EXPECT_EQ(error(incomplete_image(name, 2)), name + " is missing");
    for (std::size_t wrong : {std::size_t{3}, std::size_t{0}, std::size_t{1} << 60})
        EXPECT_THAT(error(incomplete_image("", wrong)), HasSubstr("another shape"));
    Hdf5Writer foreign;
    foreign.group("/VTKHDF");
    EXPECT_EQ(
        error(foreign.finish()),
        "/grainfield is missing: not a sphere file of grainfield; of other VTKHDF files "
        "/VTKHDF/Points and /VTKHDF/PointData/radius are read, and /VTKHDF/Points is missing");
    Hdf5Writer newer;
    newer.group("/grainfield");
    const std::int64_t version = 99;
    newer.attribute("/grainfield", "format_version", std::span(&version, 1));
    EXPECT_EQ(error(newer.finish()), "format version 99; this program reads 1");
}

// As VTK writes particles: PolyData, points in single precision or double, a column of radii.
TEST_F(SphereH5Test, TakesCentresAndRadiiOfOtherPrograms) {
    for (const std::string size : {"radius", "diameter"}) {
        Hdf5Writer foreign;
        foreign.group("/VTKHDF");
        foreign.group("/VTKHDF/PointData");
        foreign.dataset<double>("/VTKHDF/Points", {2, 3}, std::vector<double>{0, 1, 2, 3, 4, 5});
        foreign.dataset<double>("/VTKHDF/PointData/" + size, {2}, std::vector<double>{0.5, 0.25});
        const SphereFile file = read_spheres(text_file("s.h5", foreign.finish()));
        ASSERT_EQ(file.spheres.size(), 2u);
        EXPECT_EQ(file.spheres.position[1], Vec3(3, 4, 5));
        EXPECT_EQ(file.spheres.radius[1], size == "radius" ? 0.25 : 0.125);
        EXPECT_FALSE(file.box || file.has_velocity || file.has_normal_stiffness);
        EXPECT_EQ(file.notes.size(), 1u);
    }
    Hdf5Writer points;
    points.group("/VTKHDF");
    points.dataset<double>("/VTKHDF/Points", {1, 3}, std::vector<double>(3));
    EXPECT_THAT(error(points.finish()), HasSubstr("/VTKHDF/PointData/radius is missing"));
}

TEST_F(SphereH5Test, RefusesAListOfTextsForOne) {
    // Read as one text, five overran the memory for it.
    const std::string recipe{0, 0, 0, 3, 1, 5};  // the attribute `kind`: a row of five
    EXPECT_EQ(error(fuzz::made_h5(recipe)),
              "attribute kind of /grainfield is no text of fixed length");
    EXPECT_EQ(read_spheres(text_file("s.h5", fuzz::made_h5(""))).spheres.size(), 2u);
}

TEST_F(SphereH5Test, WritesAFullSampleFast) {
    const SphereFile sample = make_sample(151632);
    const auto start = std::chrono::steady_clock::now();
    write_spheres(in_folder("s.h5"), sample);
    const auto written = std::chrono::steady_clock::now();
    expect_same(read_spheres(in_folder("s.h5")), sample);
    const std::chrono::duration<double> writing = written - start;
    const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - written;
    RecordProperty("write_ms", static_cast<int>(1e3 * writing.count()));
    RecordProperty("read_ms", static_cast<int>(1e3 * reading.count()));
    RecordProperty("bytes", static_cast<int>(std::filesystem::file_size(in_folder("s.h5"))));
    EXPECT_LT(writing.count(), 10.0);  // some 0.7 s in Release; sanitizers and busy machines
}

}  // namespace
}  // namespace grainfield::core
