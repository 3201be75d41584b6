// From files and random fields to the sample of a test.
#include "triaxial/realization/sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/triaxial/small_test.hpp"
#include "triaxial/realization/packing_files.hpp"

namespace grainfield::triaxial {
namespace {

using packing::testing::spheres_of;
using ::testing::HasSubstr;

/// A folder for files, removed at the end.
class SampleFiles : public ::testing::Test {
  protected:
    SampleFiles() { std::filesystem::create_directories(folder_); }
    ~SampleFiles() override { std::filesystem::remove_all(folder_); }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() /
        ("grainfield_triaxial_" + std::to_string(::getpid()) + "_" +
         ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// A sphere at the middle of every cell of 2 x 3 x 2 cells of 0.25 m, from (1, 2, 3) on.
Sample grid_sample() {
    Sample sample;
    sample.box = {Vec3(1, 2, 3), Vec3(1.5, 2.75, 3.5)};
    sample.spheres = spheres_of(std::vector<double>(12, 0.1), {});
    for (int i = 0; i < 12; ++i) {
        const Vec3 cell(i % 2, i / 2 % 3, i / 6);
        sample.spheres.position.set(static_cast<std::size_t>(i),
                                    sample.box.lower + 0.25 * (cell + Vec3::Constant(0.5)));
    }
    return sample;
}

Config grid_config(randomfield::Variable variable) {
    Config config;
    config.packing.blocks = {2, 3, 2};
    config.field.variable = variable;
    config.field.correlation_length = Vec3(1, 0.1, 1);
    return config;
}

TEST(MapField, SphereTakesTheValueOfItsBlockNotOfItsPlace) {
    for (const auto variable : {randomfield::Variable::stiffness, randomfield::Variable::friction,
                                randomfield::Variable::both}) {
        SCOPED_TRACE(static_cast<int>(variable));
        Sample sample = grid_sample();
        core::ParticleStore& s = sample.spheres;
        for (std::size_t i = 0; i < 12; ++i) {  // blocks in the opposite order of places
            const int b = 11 - static_cast<int>(i);
            s.block[i] = {b % 2, b / 2 % 3, b / 6};
        }
        const FieldRecord record = map_field(grid_config(variable), 4, sample);
        EXPECT_EQ(record.realization, 4);
        EXPECT_GT(record.gamma, 0);
        EXPECT_LT(record.gamma, 1);
        EXPECT_FALSE(record.covariance_error);  // takes long, and a campaign has no use for it
        for (std::size_t i = 0; i < 12; ++i) {
            const std::size_t cell = 11 - i;
            EXPECT_EQ(s.normal_stiffness[i], record.field.normal_stiffness.empty()
                                                 ? 9e8
                                                 : record.field.normal_stiffness[cell]);
            EXPECT_EQ(s.friction_angle[i], record.field.friction_angle.empty()
                                               ? 0.6
                                               : record.field.friction_angle[cell]);
        }
        EXPECT_EQ(record.field.normal_stiffness.empty(),
                  variable == randomfield::Variable::friction);
        EXPECT_EQ(record.field.friction_angle.empty(),
                  variable == randomfield::Variable::stiffness);
    }
}

TEST(MapField, CovarianceErrorIsThatOfTheMethodWhereItCanBeComputed) {
    Config config = grid_config(randomfield::Variable::friction);
    const auto exact = field_covariance_error(config);
    ASSERT_TRUE(exact);
    EXPECT_LT(*exact, 1e-12);  // 12 cells are not subdivided
    config.field.stage0_cells = 4;
    const auto subdivided = field_covariance_error(config);
    ASSERT_TRUE(subdivided);
    EXPECT_GT(*subdivided, 1e-4);
    EXPECT_LT(*subdivided, 0.05);
    config.packing.blocks = {13, 13, 13};  // too many cells, but known to the circulant method
    EXPECT_FALSE(field_covariance_error(config));
    config.field.correlation_length = Vec3(0.5, 0.1, 0.5);
    config.field.method = randomfield::Method::circulant;
    EXPECT_TRUE(field_covariance_error(config));
    config.field.variable = randomfield::Variable::none;
    EXPECT_FALSE(field_covariance_error(config));
}

TEST(MapField, SphereWithoutBlockTakesTheCellItLiesIn) {
    Sample sample = grid_sample();
    const FieldRecord record = map_field(grid_config(randomfield::Variable::stiffness), 0, sample);
    double sum = 0;
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_EQ(sample.spheres.normal_stiffness[i], record.field.normal_stiffness[i]) << i;
        sum += record.field.normal_stiffness[i];
    }
    EXPECT_NEAR(record.mean_ratio_cells, sum / 12 / 9e8, 1e-12);
    // E[k]/mu = exp(-s^2 (1 - gamma)/2), s^2 = ln(1 + cov^2).
    EXPECT_NEAR(record.mean_ratio_expected,
                std::exp(-0.5 * std::log(1 + 0.64) * (1 - record.gamma)), 1e-12);
}

TEST(MapField, NothingHappensWithoutAVariable) {
    Sample sample = grid_sample();
    sample.spheres.block[0] = {99, 0, 0};
    const Sample before = sample;
    map_field(grid_config(randomfield::Variable::none), 0, sample);
    EXPECT_EQ(sample.spheres.normal_stiffness, before.spheres.normal_stiffness);
    EXPECT_EQ(sample.spheres.friction_angle, before.spheres.friction_angle);
}

TEST(MapField, BlockOutsideTheGridIsRefused) {
    for (const core::BlockIndex& block :
         {core::BlockIndex{2, 0, 0}, core::BlockIndex{0, 3, 0}, core::BlockIndex{0, -1, 0}}) {
        Sample sample = grid_sample();
        for (auto& b : sample.spheres.block) b = {0, 0, 0};
        sample.spheres.block[7] = block;
        const std::string message = message_of<InputError>(
            [&] { map_field(grid_config(randomfield::Variable::friction), 0, sample); });
        EXPECT_THAT(message, HasSubstr("packing.blocks = [2, 3, 2]"));
        EXPECT_THAT(message, HasSubstr("sphere 7"));
    }
}

TEST_F(SampleFiles, TextTakesTheConfigsPropertiesUnlessItBringsThem) {
    Config config;
    config.particle.density = 1000;
    config.particle.normal_stiffness = 5e7;
    config.particle.friction_angle = 0.4;
    const core::SphereFile plain =
        read_packing(write("a.csv", "x,y,z,radius\n0,0,0,0.1\n0.3,0.1,0,0.2\n"), config);
    ASSERT_EQ(plain.spheres.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(plain.spheres.normal_stiffness[i], 5e7);
        EXPECT_EQ(plain.spheres.friction_angle[i], 0.4);
    }
    EXPECT_NEAR(plain.spheres.mass[0], 1000 * packing::testing::sphere_volume(0.2), 1e-12);
    ASSERT_TRUE(plain.box);
    EXPECT_EQ(plain.box->lower, Vec3(-0.1, -0.1, -0.2));
    EXPECT_EQ(plain.box->upper, Vec3(0.5, 0.1 + 0.2, 0.2));

    const core::SphereFile with_columns = read_packing(
        write("b.csv", "x,y,z,radius,normal_stiffness\n0,0,0,0.1,1e6\n0.3,0,0,0.2,2e6\n"), config);
    EXPECT_EQ(with_columns.spheres.normal_stiffness[0], 1e6);
    EXPECT_EQ(with_columns.spheres.normal_stiffness[1], 2e6);
    EXPECT_EQ(with_columns.spheres.friction_angle[1], 0.4);
}

TEST_F(SampleFiles, OverlappingSpheresAreRefused) {
    const auto path = write("a.csv", "x,y,z,radius\n0,0,0,0.1\n0.05,0,0,0.1\n");
    EXPECT_THAT(message_of<InputError>([&] { read_packing(path, {}); }), HasSubstr("a.csv"));
    EXPECT_THROW(read_packing(folder_ / "none.csv", {}), FileError);
}

TEST_F(SampleFiles, AColumnForWhatTheFieldMakesRandomIsRefused) {
    using randomfield::Variable;
    const auto path = write("a.csv", "x,y,z,radius,normal_stiffness\n0,0,0,0.1,1e8\n");
    for (const Variable variable : {Variable::stiffness, Variable::both})
        EXPECT_THAT(message_of<InputError>([&] { read_packing(path, grid_config(variable)); }),
                    HasSubstr("a.csv: brings a column for the property that field.variable makes"));
    for (const Variable variable : {Variable::friction, Variable::none})
        EXPECT_EQ(read_packing(path, grid_config(variable)).spheres.normal_stiffness[0], 1e8);
    const auto rough = write("b.csv", "x,y,z,radius,friction_angle\n0,0,0,0.1,0.3\n");
    EXPECT_THROW(read_packing(rough, grid_config(Variable::friction)), InputError);
    EXPECT_EQ(read_packing(rough, grid_config(Variable::stiffness)).spheres.friction_angle[0], 0.3);
}

TEST_F(SampleFiles, ContactsOfAStartAreThoseOfItsSpheresAndWalls) {
    const Sample sample = grid_sample();
    const auto start = [&](std::vector<std::size_t> shape, std::vector<double> values) {
        core::SphereFile file;
        file.spheres = sample.spheres;
        file.box = sample.box;
        file.kind = "start";
        file.extra["contacts"] = {std::move(shape), std::move(values)};
        return sample_of(std::move(file), "start.h5");
    };
    const Sample good = start({2, 5}, {0, 11, 1, 2, 3, 5, -6, 4, 5, 6});
    ASSERT_EQ(good.contacts.size(), 2u);
    EXPECT_EQ(good.contacts[1].i, 5);
    EXPECT_EQ(good.contacts[1].j, -6);
    EXPECT_EQ(good.contacts[1].shear, Vec3(4, 5, 6));
    for (const auto& row : {std::vector<double>{-1, 1, 0, 0, 0},
                            {12, 1, 0, 0, 0},
                            {0, -7, 0, 0, 0},
                            {0, 12, 0, 0, 0},
                            {0, std::nan(""), 0, 0, 0}})
        EXPECT_THAT(message_of<FileError>([&] {
                        start({1, 5}, row);
                    }),
                    HasSubstr("start.h5: its contacts are damaged"));
    EXPECT_THROW(start({5}, {0, 1, 0, 0, 0}), FileError);
    EXPECT_THROW(start({1, 4}, {0, 1, 0, 0}), FileError);
}

TEST_F(SampleFiles, PackingComesBackBitForBitWithTheConfigsProperties) {
    packing::Packing p;
    const Sample sample = grid_sample();
    p.spheres = sample.spheres;
    p.box = sample.box;
    for (std::size_t i = 0; i < 12; ++i) p.spheres.block[i] = {static_cast<int>(i), 1, 2};
    p.block.spheres = p.spheres;
    p.block.grading.diameter = {0.2};
    p.options.isotropic_stress = 1e3;
    p.state_hash = "0123456789abcdef";
    write_packing(folder_ / "p.h5", p, 1.5);
    Config config;
    config.particle.normal_stiffness = 1e8;
    config.particle.friction_angle = 0.2;
    const core::SphereFile read = read_packing(folder_ / "p.h5", config);
    EXPECT_EQ(read.spheres.position, p.spheres.position);
    EXPECT_EQ(read.spheres.radius, p.spheres.radius);
    EXPECT_EQ(read.spheres.block, p.spheres.block);
    ASSERT_TRUE(read.box);
    EXPECT_EQ(read.box->lower, p.box.lower);
    EXPECT_EQ(read.box->upper, p.box.upper);
    for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_EQ(read.spheres.normal_stiffness[i], 1e8);
        EXPECT_EQ(read.spheres.friction_angle[i], 0.2);
    }
    const auto json = nlohmann::json::parse(std::ifstream(json_beside(folder_ / "p.h5")));
    for (const char* key :
         {"particles", "porosity", "block_spheres", "block_mean_stress_Pa",
          "compaction_friction_angle_rad", "coordination_number", "mechanical_coordination_number",
          "rattler_fraction", "vertical_stress_slope_ratio", "vertical_stress_r2", "K0",
          "wall_seconds", "state_hash"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["particles"], 12);
    EXPECT_EQ(json["wall_seconds"], 1.5);
}

}  // namespace
}  // namespace grainfield::triaxial
