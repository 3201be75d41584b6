// What is too deep, too large or of no known kind is refused before it is read, or before the work:
// with a message, in no time, and without the memory that it asks for.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>

#include <chrono>

#include "tests/program/program.hpp"

namespace grainfield::program_tests {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int k = 0; k < times; ++k) all += text;
    return all;
}

void expect_refused(const Outcome& outcome, int code, const std::string& message) {
    EXPECT_EQ(outcome.code, code) << outcome.err.substr(0, 1000);
    EXPECT_THAT(outcome.err.substr(0, 1000), HasSubstr("grainfield: "));
    EXPECT_TRUE(outcome.err.find(message) != std::string::npos) << outcome.err.substr(0, 1000);
}

TEST(Limits, DeepTomlIsRefused) {
    const Workplace place;
    const std::string out = place.path("f.csv");
    constexpr int deep = 40000;  // as an argument of the command line may be long
    const std::string dotted = repeated("a.", deep) + "a";
    for (const std::string& text : {"a = " + repeated("[", deep) + repeated("]", deep),
                                    "a = " + repeated("{a=", deep) + "1" + repeated("}", deep),
                                    dotted + " = 1", "[" + dotted + "]\n", "[[" + dotted + "]]\n",
                                    "a = [ # ]\n" + repeated("[ # ]\n", deep) + repeated("]", deep),
                                    "a = \"[\"\nb = '''[\n'''\nc = " + repeated("[", deep)}) {
        const Outcome run = place.run({"field", place.write("c.toml", text), "--out", out});
        expect_refused(run, 2, "nested deeper than 100 levels");
        EXPECT_THAT(run.err.substr(0, 1000), HasSubstr("c.toml:"));
    }
    for (const std::string& setting :
         {dotted + "=1", "a=" + repeated("[", deep), "a=" + repeated("{a=", deep)})
        expect_refused(place.run({"field", "--out", out, "--set", setting}), 2,
                       "nested deeper than 100 levels");
    place.write("c.toml", "# Not deep: " + repeated("[.", 200) + "\nfield.seed = 1\n");
    EXPECT_EQ(place.run({"field", place.path("c.toml"), "--out", out}).code, 0);
}

TEST(Limits, DeepJsonIsRefused) {
    const Workplace place;
    for (const char* folder : {"run", "campaign"}) fs::create_directory(place.path(folder));
    constexpr int deep = 1000000;
    for (const std::string& text :
         {repeated("[", deep) + repeated("]", deep),
          "{\"a\":" + repeated("{\"a\":", deep) + "1" + repeated("}", deep + 1)}) {
        expect_refused(place.run({"info", place.write("a.json", text)}), 4, "nested deeper");
        for (const std::string file : {"run/summary.json", "campaign/campaign.json"}) {
            place.write(file, text);
            expect_refused(place.run({"report", fs::path(place.path(file)).parent_path()}), 4,
                           "nested deeper");
        }
        expect_refused(
            place.run({"montecarlo", place.write("c.toml", ""), "--out", place.path("campaign")}),
            4, "campaign.json: damaged");
    }
}

/// A sphere file whose dataset /VTKHDF/Points is another one.
std::string with_other_points(const Workplace& place, hid_t creation, hsize_t rows, hid_t type) {
    place.write("a.csv", "x,y,z,radius\n0,0,0,0.1\n1,0,0,0.1\n");
    EXPECT_EQ(place.run({"convert", place.path("a.csv"), place.path("a.h5")}).code, 0);
    const hid_t file = H5Fopen(place.path("a.h5").c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    EXPECT_GE(H5Ldelete(file, "/VTKHDF/Points", H5P_DEFAULT), 0);
    const hsize_t size[] = {rows, 3}, most[] = {H5S_UNLIMITED, 3};
    const bool grows = H5Pget_layout(creation) == H5D_CHUNKED;
    const hid_t space = H5Screate_simple(2, size, grows ? most : nullptr);
    const hid_t points =
        H5Dcreate2(file, "/VTKHDF/Points", type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    EXPECT_GE(points, 0);
    if (grows) {
        const double zeros[6] = {};
        EXPECT_GE(H5Dwrite(points, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros), 0);
    }
    H5Dclose(points);
    H5Sclose(space);
    H5Fclose(file);
    return place.path("a.h5");
}

TEST(Limits, ValuesInOtherFilesAreNotRead) {
    const Workplace place;
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(creation, "/dev/zero", 0, 2 * 3 * sizeof(double));
    const std::string file = with_other_points(place, creation, 2, H5T_NATIVE_DOUBLE);
    H5Pclose(creation);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"info", file}, {"convert", file, place.path("b.csv")}})
        expect_refused(place.run(words), 4, "keeps its values in other files");
}

TEST(Limits, CompressedNothingIsNotUnpacked) {
    const Workplace place;
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t chunk[] = {8'000'000, 3};
    H5Pset_chunk(creation, 2, chunk);
    H5Pset_deflate(creation, 9);
    const std::string file = with_other_points(place, creation, 2, H5T_NATIVE_DOUBLE);
    H5Pclose(creation);
    EXPECT_LT(fs::file_size(file), 1'000'000u);
    expect_refused(place.run({"info", file}), 4, "wants 192 MB of memory out of a file of");
}

TEST(Limits, FilesWithoutEndAreRefused) {
    const Workplace place;
    for (const char* name : {"a.csv", "a.h5", "a.json", "a.txt", "a.data"}) {
        fs::create_symlink("/dev/zero", place.path(name));
        expect_refused(place.run({"info", place.path(name)}), 4, "larger than 256 MB");
    }
    fs::create_symlink("/dev/zero", place.path("c.toml"));
    expect_refused(place.run({"field", place.path("c.toml"), "--out", place.path("f.csv")}), 4,
                   "larger than 16 MiB");
}

TEST(Limits, SpheresThatDoNotFitAreRefusedBeforePacking) {
    const Workplace place;
    const auto begin = std::chrono::steady_clock::now();
    for (const auto& [begins, keys] :
         {std::pair<std::string, std::vector<std::string>>{"packing.blocks = [",
                                                           {"packing.blocks=[1000,1000,1000]"}},
          {"packing.spheres = 2000000000", {"packing.spheres=2000000000"}},
          {"grading.sieve_diameter = [2e-06, ",
           {"grading.sieve_diameter=[2e-6,0.02,0.2]", "grading.passing=[0,10,100]"}}}) {
        std::vector<std::string> words{"pack", "--out", place.path("P.h5")};
        for (const std::string& key : keys) words.insert(words.end(), {"--set", key});
        expect_refused(place.run(words), 2, begins);
        EXPECT_FALSE(place.has("P.checkpoint.lock"));
    }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(Limits, FormatsAreKnownBeforeTheWork) {
    const Workplace place;
    const std::string out = place.path("P.xyz");
    for (const std::vector<std::string>& words : {std::vector<std::string>{"pack", "--out", out},
                                                  {"convert", place.path("none.csv"), out},
                                                  {"field", "--out", out}})
        expect_refused(place.run(words), 2, "P.xyz: ");
    expect_refused(place.run({"pack", "--out", place.path("none/P.h5")}), 4,
                   "its folder does not exist");
}

TEST(Limits, EverySettingHasASetOfItsOwn) {
    const Workplace place;
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"--set", "field.seed=1", "field.stage0_cells=64"},
          {"--set=field.seed=1", "field.stage0_cells=64"}}) {
        std::vector<std::string> all{"field", "--out", place.path("f.csv")};
        all.insert(all.end(), words.begin(), words.end());
        expect_refused(place.run(all), 2, "give --set again for each key");
    }
    // A file may be called so.
    const std::string file = place.write("a=b.toml", "");
    EXPECT_EQ(
        place.run({"field", "--out", place.path("f.csv"), "--set", "field.seed=1", file}).code, 0);
}

}  // namespace
}  // namespace grainfield::program_tests
