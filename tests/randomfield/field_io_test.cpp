// Field files: every number comes back, failures leave nothing behind.

#include "randomfield/field_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

namespace fs = std::filesystem;

class FieldFile : public testing::Test {
  protected:
    void SetUp() override {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = fs::temp_directory_path() /
                  (std::string("grainfield-") + info->name() + std::to_string(::getpid()));
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    static FieldGenerator generator(Variable variable) {
        GridSpec grid;
        grid.cells = {2, 3, 4};
        FieldOptions options;
        options.variable = variable;
        options.seed = 5;
        return {grid, options};
    }

    fs::path folder_;
};

std::vector<std::string> lines_of(const fs::path& path) {
    std::ifstream in(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

TEST_F(FieldFile, CsvHoldsEveryNumberExactly) {
    for (const Variable variable : {Variable::none, Variable::friction, Variable::both}) {
        const FieldGenerator fields = generator(variable);
        const fs::path path = folder_ / "field.csv";
        write_fields(path, fields, 3, {.friction_angle = 0.55, .normal_stiffness = 1.5e8});
        const auto lines = lines_of(path);
        ASSERT_EQ(lines.size(), 1u + 3u * 24u);
        EXPECT_EQ(lines[0], "realization,i,j,k,G,friction_angle,normal_stiffness");
        std::size_t line = 1;
        for (std::uint64_t r = 0; r < 3; ++r) {
            const BlockField field = fields.draw(r);
            for (std::int32_t k = 0; k < 4; ++k) {
                for (std::int32_t j = 0; j < 3; ++j) {
                    for (std::int32_t i = 0; i < 2; ++i, ++line) {
                        const std::size_t cell = field.grid.index(i, j, k);
                        std::vector<double> n;
                        std::istringstream row(lines[line]);
                        for (std::string cellText; std::getline(row, cellText, ',');) {
                            double value = 0.0;
                            std::from_chars(cellText.data(), cellText.data() + cellText.size(),
                                            value);
                            n.push_back(value);
                        }
                        const bool phi = !field.friction_angle.empty();
                        const bool kn = !field.normal_stiffness.empty();
                        EXPECT_EQ(n, (std::vector<double>{
                                         static_cast<double>(r), static_cast<double>(i),
                                         static_cast<double>(j), static_cast<double>(k),
                                         field.G[cell], phi ? field.friction_angle[cell] : 0.55,
                                         kn ? field.normal_stiffness[cell] : 1.5e8}));
                    }
                }
            }
        }
    }
}

std::vector<double> read_dataset(hid_t file, const char* name, std::vector<hsize_t>& shape) {
    const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(dataset);
    shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    std::size_t size = 1;
    for (const hsize_t n : shape) size *= n;
    std::vector<double> values(size);
    EXPECT_GE(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
    H5Sclose(space);
    H5Dclose(dataset);
    return values;
}

TEST_F(FieldFile, H5HoldsEveryNumberExactly) {
    const FieldGenerator fields = generator(Variable::both);
    const fs::path path = folder_ / "field.h5";
    write_fields(path, fields, 3, {});
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    ASSERT_GE(file, 0);
    std::vector<double> g, g_stiffness, phi, kn;
    for (std::uint64_t r = 0; r < 3; ++r) {
        const BlockField field = fields.draw(r);
        g.insert(g.end(), field.G.begin(), field.G.end());
        g_stiffness.insert(g_stiffness.end(), field.G_stiffness.begin(), field.G_stiffness.end());
        phi.insert(phi.end(), field.friction_angle.begin(), field.friction_angle.end());
        kn.insert(kn.end(), field.normal_stiffness.begin(), field.normal_stiffness.end());
    }
    std::vector<hsize_t> shape;
    EXPECT_EQ(read_dataset(file, "G", shape), g);
    EXPECT_EQ(shape, (std::vector<hsize_t>{3, 4, 3, 2}));  // [realization][z][y][x]
    EXPECT_EQ(read_dataset(file, "G_stiffness", shape), g_stiffness);
    EXPECT_EQ(read_dataset(file, "friction_angle", shape), phi);
    EXPECT_EQ(read_dataset(file, "normal_stiffness", shape), kn);
    EXPECT_EQ(read_dataset(file, "correlation_length", shape),
              (std::vector<double>{10.0, 1.0, 10.0}));
    EXPECT_EQ(read_dataset(file, "cell_size", shape), (std::vector<double>{0.25, 0.25, 0.25}));
    const hid_t attribute = H5Aopen_by_name(file, "/", "seed", H5P_DEFAULT, H5P_DEFAULT);
    std::int64_t seed = 0;
    EXPECT_GE(H5Aread(attribute, H5T_NATIVE_INT64, &seed), 0);
    EXPECT_EQ(seed, 5);
    H5Aclose(attribute);
    H5Fclose(file);
}

TEST_F(FieldFile, EqualFieldsGiveEqualBytes) {
    for (const char* suffix : {".csv", ".h5"}) {
        std::string bytes[2];
        for (int n = 0; n < 2; ++n) {
            const fs::path path = folder_ / (std::to_string(n) + suffix);
            write_fields(path, generator(Variable::stiffness), 2, {});
            std::ifstream in(path, std::ios::binary);
            bytes[n].assign(std::istreambuf_iterator<char>(in), {});
        }
        EXPECT_FALSE(bytes[0].empty());
        EXPECT_EQ(bytes[0], bytes[1]) << suffix;
    }
}

TEST_F(FieldFile, FailuresNameTheFileAndLeaveTheOldOne) {
    const FieldGenerator fields = generator(Variable::none);
    EXPECT_THROW(write_fields(folder_ / "no" / "field.csv", fields, 1, {}), FileError);
    EXPECT_THROW(write_fields(folder_ / "no" / "field.h5", fields, 1, {}), FileError);
    EXPECT_THAT(input_error([&] { write_fields(folder_ / "field.txt", fields, 1, {}); }),
                testing::AllOf(testing::HasSubstr("field.txt"), testing::HasSubstr(".csv or .h5")));
    const fs::path old = folder_ / "field.csv";
    std::ofstream(old) << "old\n";
    EXPECT_NE(input_error([&] { write_fields(old, fields, 0, {}); }), "");
    EXPECT_EQ(lines_of(old), std::vector<std::string>{"old"});
    // A folder in the file's place: nothing is left beside it.
    fs::create_directory(folder_ / "taken.csv");
    EXPECT_THROW(write_fields(folder_ / "taken.csv", fields, 1, {}), FileError);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
}

}  // namespace
}  // namespace grainfield::randomfield
