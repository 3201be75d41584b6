#include "core/files/file_info.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/files/hdf5_writer.hpp"
#include "core/files/json_text.hpp"
#include "core/files/sphere_checks.hpp"
#include "core/files/sphere_formats.hpp"
#include "core/files/text_file.hpp"
#include "tests/files/sample.hpp"

namespace grainfield::core {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
class FileInfoTest : public FilesTest {
  protected:
    std::string info(const std::string& name, const std::string& text) const {
        return describe_file(text_file(name, text));
    }
};

TEST_F(FileInfoTest, DescribesASphereFile) {
    SphereFile file;
    file.spheres.resize(3);
    file.spheres.radius = {0.5, 0.25, 1};
    file.spheres.position.x = {0, 2, 4};
    file.spheres.block[2] = {5, 0, 1};
    file.spheres.set_density(2600);
    file.box = Box{{-1, -1, -1}, {5, 1, 1}};
    file.has_block = true;
    file.kind = "packing";
    file.producer = "grainfield 1.2.3";
    file.attributes = json_text({{"porosity", 0.4}, {"list", {1, 2, 3}}});
    file.extra["contacts"] = {{2, 2}, {0, 1, 1, 2}};
    write_spheres(in_folder("s.h5"), file);
    EXPECT_EQ(describe_file(in_folder("s.h5")),
              "sphere file: 3 spheres, packing, by grainfield 1.2.3\n"
              "box: (-1, -1, -1) to (5, 1, 1) m, 6 x 2 x 2 m\n"
              "bounding box of the spheres: (-0.5, -1, -1) to (5, 1, 1) m, 5.5 x 2 x 2 m\n"
              "radii: 0.25 to 1 m, median 0.5 m\n"
              "solid volume: 4.77784 m3\n"     // 4/3 pi (1/8 + 1/64 + 1)
              "porosity in the box: 0.8009\n"  // 1 - 4.77784 / 24
              "blocks: 1, indices up to 6 x 1 x 2\n"
              "columns: x, y, z, radius, mass, block\n"
              "extra: contacts, 4 values\n"
              "attributes:\n  list: array of 3 entries\n  porosity: 0.4\n");
    for (const char* name : {"s.csv", "s.data", "s.txt"}) {
        write_spheres(in_folder(name), file);
        EXPECT_THAT(describe_file(in_folder(name)),
                    AllOf(StartsWith("sphere file: 3 spheres\n"), HasSubstr("median 0.5 m")));
    }
    EXPECT_THAT(message_of<InputError>([&] { info("e.csv", "x,y,z,radius\n"); }),
                HasSubstr("no sphere; at least one needed"));
}

TEST_F(FileInfoTest, CountsAMissingBlockAsNone) {
    SphereFile file;
    file.spheres.resize(2);
    file.spheres.radius = {1, 1};
    file.spheres.block[1] = {0, 0, 0};
    file.has_block = true;
    write_spheres(in_folder("s.h5"), file);
    EXPECT_THAT(describe_file(in_folder("s.h5")),
                HasSubstr("blocks: 1, indices up to 1 x 1 x 1\n"));
}

TEST_F(FileInfoTest, DescribesTables) {
    EXPECT_EQ(info("f.csv",
                   "realization,i,j,k,G,friction_angle,normal_stiffness\n"
                   "0,0,0,0,-1.5,0.6,9e8\n0,0,0,1,0.25,0.7,8e8\n"),
              "random field: 2 rows, 7 columns\n  realization: 0 to 0\n  i: 0 to 0\n  j: 0 to 0\n"
              "  k: 0 to 1\n  G: -1.5 to 0.25\n  friction_angle: 0.6 to 0.7\n"
              "  normal_stiffness: 8e+08 to 9e+08\n");
    EXPECT_THAT(info("c.csv", "axial_strain,deviator_stress_Pa,axial_stress_Pa\n"),
                StartsWith("curve of a triaxial test: 0 rows, 3 columns\n"));
    EXPECT_THAT(info("r.csv", "case,realization,seed,status\nbase,0,1,done\nbase,1,2,failed\n"),
                AllOf(StartsWith("results of a campaign: 2 rows, 4 columns\n"),
                      HasSubstr("  case: base\n"), HasSubstr("  status: done, failed\n")));
    EXPECT_THAT(info("t.csv", "a,b\n1,2\n"), StartsWith("table: 1 rows, 2 columns\n"));
    const auto cut = text_file("r.csv", "a,b,c\n1,2,3\n4,5");
    EXPECT_EQ(message_of<InputError>([&] { describe_file(cut); }),
              cut.string() + ":3: 2 fields, but the header has 3");
    EXPECT_THROW(info("e.csv", ""), InputError);
    EXPECT_THAT(message_of<InputError>([&] { info("n.csv", "0.1,0.2,0.3,0.05\n"); }),
                HasSubstr("begins with a number"));
}

// What convert refuses as a sphere file is no other table for info.
TEST_F(FileInfoTest, RefusesSphereFilesInForeignForms) {
    struct Form {
        const char *text, *said;
    };
    for (const Form& form :
         {Form{"x;y;z;radius\r\n0,1;0,1;0,1;0,05\r\n",
               "separated by semicolons (;): must be commas (,); its numbers have decimal commas"},
          {"x\ty\tz\tradius\n0.1\t0.1\t0.1\t0.05\n", "separated by tabs"},
          {"x y z radius\n0.1 0.1 0.1 0.05\n", "separated by blanks"},
          {"\"x\",\"y\",\"z\",\"radius\"\n0.1,0.1,0.1,0.05\n", "names stand in quotes"},
          {"x,y,z,radius\r0.1,0.1,0.1,0.05\r", "end with CR alone (old Mac)"},
          {"x,y,z,radius,\n0.1,0.1,0.1,0.05,\n", "it ends with ','"},
          {"x,y,z,radius\n0,1,0,1,0,1,0,05\n",
           "8 fields, but the header has 4; if its numbers have "
           "decimal commas: must be points"},
          {"x,y,z,radius\n1.0D-01,0.1,0.1,0.05\n", "its exponent begins with D: must be e or E"},
          {"x,y,z,radius\n\"0.1\",0.1,0.1,0.05\n", "the number stands in quotes"},
          {"x,y,z,radius\n0.1;0.1;0.1;0.05\n", "semicolons (;) stand in it"},
          {"x,y,z,r\n0,0,0,1\n", "column 'r' is unknown"},
          {"x,y,z,radius\n", "no sphere; at least one needed"}}) {
        SCOPED_TRACE(form.text);
        const auto path = text_file("s.csv", form.text);
        const std::string said = message_of<InputError>([&] { describe_file(path); });
        EXPECT_THAT(said, HasSubstr(form.said));
        EXPECT_EQ(message_of<InputError>([&] {
                      const SphereFile file = read_spheres(path);
                      check_spheres(file.spheres, path.string(), file.lines);
                  }),
                  said);
    }
}

TEST_F(FileInfoTest, DescribesJsonTomlAndOtherHdf5) {
    EXPECT_EQ(info("a.json", R"({"porosity": 0.4, "wall_seconds": {"pack": 1}, "isa": "avx2"})"),
              "JSON: 3 keys\n  isa: \"avx2\"\n  porosity: 0.4\n"
              "  wall_seconds: object of 1 entries\n");
    EXPECT_EQ(info("a.toml", "# c\n[grading]\na = 1\n[field]\n[field.friction]\n[[wall]]\n"),
              "TOML: 54 bytes, 3 tables\n  [grading]\n  [field]\n  [wall]\n");
    Hdf5Writer writer;
    writer.group("/field");
    writer.dataset<double>("/field/G", {2, 3}, std::vector<double>(6));
    EXPECT_EQ(info("f.h5", writer.finish()), "HDF5 file\n  /field/G: 2 x 3\n");
}

TEST_F(FileInfoTest, NamesDamagedAndUnknownFiles) {
    EXPECT_THAT(message_of<FileError>([&] { info("a.json", "{\"porosity\": 0."); }),
                HasSubstr("a.json: "));
    const std::string image = format_sphere_h5(make_sample(50));
    EXPECT_THAT(message_of<FileError>([&] { info("s.h5", image.substr(0, image.size() / 2)); }),
                HasSubstr("s.h5: damaged HDF5 file"));
    EXPECT_THAT(message_of<FileError>([&] { info("s.h5", "hello"); }), HasSubstr("not an HDF5"));
    EXPECT_THAT(message_of<InputError>([&] { info("s.csv", "x,y,z,radius\n1,2,3,x\n"); }),
                HasSubstr("s.csv:2: column radius = x"));
    EXPECT_THAT(message_of<InputError>([&] { info("s.png", "x"); }),
                HasSubstr("suffix '.png' is not known; allowed: .h5"));
    EXPECT_THROW(describe_file(in_folder("missing.csv")), FileError);
}

}  // namespace
}  // namespace grainfield::core
