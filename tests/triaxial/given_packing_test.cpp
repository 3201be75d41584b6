// What a packing that was given says of itself, and keys that contradict it.
#include "triaxial/realization/given_packing.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "tests/triaxial/small_test.hpp"
#include "triaxial/realization/sample.hpp"

namespace grainfield::triaxial {
namespace {

using packing::testing::spheres_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Spheres of radius 0.125 m that fill 2 x 4 x 2 cells of 0.25 m, from the origin on.
core::SphereFile stacked(const std::string& kind = "") {
    core::SphereFile file;
    file.kind = kind;
    file.spheres = spheres_of(std::vector<double>(16, 0.125), {});
    for (int i = 0; i < 16; ++i)
        file.spheres.position.set(static_cast<std::size_t>(i),
                                  0.25 * Vec3(i % 2 + 0.5, i / 2 % 4 + 0.5, i / 8 + 0.5));
    file.box = core::Box{Vec3::Zero(), Vec3(0.5, 1, 0.5)};
    std::fill(file.spheres.mass.begin(), file.spheres.mass.end(), 0.0);
    return file;
}

/// As `grainfield pack` writes it.
core::SphereFile made(double porosity = 0.36) {
    core::SphereFile file = stacked("packing");
    packing::Packing p;
    p.options.seed = 7;
    p.options.blocks = {1, 2, 1};
    p.options.block = p.block.size = Vec3(0.5, 0.5, 0.5);
    p.options.porosity = porosity;
    p.block.spheres = spheres_of({0.1, 0.1}, {});
    p.grading.sieve_diameter = {0.1, 0.3};
    p.grading.passing = {0, 100};
    file.attributes = packing_attributes(p);
    file.spheres.set_density(2600);
    return file;
}

std::string contradiction(const core::SphereFile& file, const Config& config,
                          const std::string& key) {
    return message_of<InputError>([&] { config_of_packing(file, "P.h5", config, {key}); });
}

TEST(ConfigOfPacking, RecordsHowAPackingWasMade) {
    const Config config = config_of_packing(made(), "P.h5", {}, {});
    EXPECT_EQ(config.packing.porosity, 0.36);
    EXPECT_EQ(config.packing.seed, 7u);
    EXPECT_EQ(config.packing.blocks, (std::array<std::int32_t, 3>{1, 2, 1}));
    EXPECT_EQ(config.packing.block, Vec3(0.5, 0.5, 0.5));
    EXPECT_EQ(config.grading.sieve_diameter, (std::vector<double>{0.1, 0.3}));
    EXPECT_FALSE(config.packing.isotropic_stress);
    EXPECT_EQ(config.particle.density, 2600);
    // The same key with the same value is no contradiction.
    Config same;
    same.packing.porosity = 0.36;
    EXPECT_NO_THROW(config_of_packing(made(), "P.h5", same, {"packing.porosity"}));
}

TEST(ConfigOfPacking, RefusesKeysThatContradictIt) {
    Config config;
    config.packing.porosity = 0.40;
    EXPECT_EQ(
        contradiction(made(), config, "packing.porosity"),
        "packing.porosity = 0.4: contradicts the packing P.h5, which was made with 0.36; leave "
        "the key out, or give another packing");
    EXPECT_THAT(contradiction(made(), config, "packing.seed"), HasSubstr("made with 7"));
    EXPECT_THAT(contradiction(made(), config, "packing.blocks"), HasSubstr("made with [1,2,1]"));
    EXPECT_THAT(contradiction(made(), config, "packing.block"), HasSubstr("[0.5,0.5,0.5]"));
    EXPECT_THAT(contradiction(made(), config, "grading.passing"), HasSubstr("[0.0,100.0]"));
    config.packing.spheres = 351;
    EXPECT_THAT(contradiction(made(), config, "packing.spheres"), HasSubstr("blocks have 2"));
    config.packing.isotropic_stress = 1e5;
    EXPECT_THAT(contradiction(made(), config, "packing.isotropic_stress"), HasSubstr("none"));
    config.particle.density = 5200;
    EXPECT_THAT(contradiction(made(), config, "particle.density"),
                HasSubstr("whose spheres bring 2600 kg/m3"));
    // Of a file that says nothing of its making, porosity is that in its box.
    EXPECT_THAT(contradiction(stacked(), config, "packing.porosity"),
                HasSubstr("whose porosity is 0.4764"));
}

/// As `grainfield pack` writes it: a block asked to be 0.5 m high came out at 0.49 m.
core::SphereFile made_to_relative_density() {
    core::SphereFile file = made();
    auto attributes = nlohmann::json::parse(file.attributes);
    attributes["block_m"] = {0.5, 0.49, 0.5};
    attributes["block_porosity"] = 0.38;
    attributes["asked_relative_density"] = 0.7;
    file.attributes = attributes.dump();
    return file;
}

TEST(ConfigOfPacking, ABlockOfARelativeDensityIsAsHighAsItCameOut) {
    const core::SphereFile file = made_to_relative_density();
    const Config config = config_of_packing(file, "P.h5", {}, {});
    EXPECT_EQ(config.packing.relative_density, 0.7);
    EXPECT_FALSE(config.packing.compaction_friction);
    EXPECT_EQ(config.packing.block, Vec3(0.5, 0.49, 0.5));
    EXPECT_EQ(config.packing.porosity, 0.38);
    // What was asked for and what came out are both true.
    const std::set<std::string> keys{"packing.block", "packing.porosity",
                                     "packing.relative_density"};
    EXPECT_NO_THROW(config_of_packing(file, "P.h5", config, keys));
    Config asked = config;
    asked.packing.block.y() = 0.5;
    asked.packing.porosity = 0.36;
    EXPECT_NO_THROW(config_of_packing(file, "P.h5", asked, keys));
    asked.packing.block.y() = 0.48;
    EXPECT_THAT(contradiction(file, asked, "packing.block"), HasSubstr("made with [0.5,0.49,0.5]"));
    asked.packing.relative_density = 0.8;
    EXPECT_THAT(contradiction(file, asked, "packing.relative_density"), HasSubstr("with 0.7"));
    EXPECT_THAT(contradiction(made(), asked, "packing.relative_density"),
                HasSubstr("which was made without"));
}

TEST(ConfigOfPacking, DensityOfTheFileIsTheConfigs) {
    core::SphereFile file = stacked();
    EXPECT_EQ(config_of_packing(file, "P.csv", {}, {}).particle.density, 2600);
    file.spheres.set_density(5200);
    EXPECT_NEAR(config_of_packing(file, "P.data", {}, {}).particle.density, 5200, 1e-9);
    EXPECT_EQ(density_text(file.spheres), "5200 kg/m3");
    file.spheres.mass[3] *= 0.5;
    EXPECT_EQ(density_text(file.spheres), "2600 to 5200 kg/m3");
}

TEST(ConfigOfPacking, BlocksCoverTheSample) {
    const auto blocks = [](const core::SphereFile& file, const Config& config,
                           const std::set<std::string>& given) {
        return config_of_packing(file, "P.csv", config, given).packing;
    };
    EXPECT_EQ(blocks(stacked(), {}, {}).blocks, (std::array<std::int32_t, 3>{2, 4, 2}));
    core::SphereFile odd = stacked();
    odd.spheres.position.y[7] += 0.07;  // walls at the spheres: 1.07 m high
    const packing::PackingOptions stretched = blocks(odd, {}, {});
    EXPECT_EQ(stretched.blocks, (std::array<std::int32_t, 3>{2, 4, 2}));
    EXPECT_DOUBLE_EQ(stretched.block.y(), 1.07 / 4);
    Config config;
    config.packing.blocks = {1, 2, 1};
    EXPECT_THAT(contradiction(stacked(), config, "packing.blocks"),
                AllOf(HasSubstr("packing.blocks = [1, 2, 1]: of 0.25 x 0.25 x 0.25 m, do not fit"),
                      HasSubstr("measures 0.5 x 1 x 0.5 m")));
    config.packing.block = Vec3(0.5, 0.5, 0.5);
    EXPECT_EQ(blocks(stacked(), config, {"packing.blocks", "packing.block"}).blocks,
              config.packing.blocks);
    // Blocks that the spheres know.
    core::SphereFile known = stacked();
    known.has_block = true;
    for (std::size_t i = 0; i < 16; ++i)
        known.spheres.block[i] = {0, static_cast<std::int32_t>(i / 4 % 2), 0};
    EXPECT_EQ(blocks(known, {}, {}).blocks, (std::array<std::int32_t, 3>{1, 2, 1}));
    EXPECT_EQ(blocks(known, {}, {}).block, Vec3(0.5, 0.5, 0.5));
    config.packing.blocks = {2, 2, 1};
    EXPECT_THAT(contradiction(known, config, "packing.blocks"), HasSubstr("in 1 x 2 x 1 blocks"));
}

// The files in a campaign's cases/ give the blocks of the packing, and go with a start that is
// lower.
TEST(ConfigOfPacking, AStartThatWasCompressedKeepsTheBlocksOfItsCase) {
    Config config;
    config.packing.blocks = {1, 4, 1};
    config.packing.block = Vec3(0.5, 0.25, 0.5);
    core::SphereFile start = stacked();
    start.kind = "start";
    for (double& y : start.spheres.position.y) y *= 0.86;
    start.box->upper.y() *= 0.86;
    const Config kept =
        config_of_packing(start, "P.h5", config, {"packing.blocks", "packing.block"});
    EXPECT_EQ(kept.packing.blocks, config.packing.blocks);
    EXPECT_EQ(kept.packing.block, config.packing.block);
}

// The mean of a trend is that of the sample's mid-height, whatever the source of the packing.
TEST(ConfigOfPacking, ATrendBelongsToTheSample) {
    Config config;
    config.field.variable = randomfield::Variable::stiffness;
    config.field.stiffness.cov = 1e-6;
    config.field.stiffness.mean_gradient = -1e8;
    core::SphereFile known = stacked();
    known.has_block = true;
    for (std::size_t i = 0; i < 16; ++i)
        known.spheres.block[i] = {0, static_cast<std::int32_t>(i / 4 % 2), 0};
    const auto mean_at = [&](const core::SphereFile& file, double height) {
        const Config here = config_of_packing(file, "P", config, {});
        Sample sample{file.spheres, box_of_packing(file)};
        map_field(here, 0, sample);
        double sum = 0, count = 0;
        for (std::size_t i = 0; i < sample.spheres.size(); ++i)
            if (std::abs(sample.spheres.position.y[i] - height) < 0.01) {
                sum += sample.spheres.normal_stiffness[i];
                ++count;
            }
        return sum / count;
    };
    // Rows of 0.5 m: means at -0.25 and 0.25 m from mid-height; of 0.25 m: at -0.375 m.
    EXPECT_NEAR(mean_at(made(), 0.125) / 9.25e8, 1, 1e-4) << "no blocks of spheres: by place";
    EXPECT_NEAR(mean_at(known, 0.875) / 8.75e8, 1, 1e-4);
    EXPECT_NEAR(mean_at(stacked(), 0.125) / 9.375e8, 1, 1e-4);
}

TEST(MapField, GridThatDoesNotFitTheBoxIsRefused) {
    Sample sample{stacked().spheres, *stacked().box};
    Config config;
    config.field.variable = randomfield::Variable::stiffness;
    EXPECT_THAT(message_of<InputError>([&] { map_field(config, 0, sample); }),
                HasSubstr("the field's grid measures 1.5 m along x, but the sample 0.5 m"));
}

// A campaign's start has been compressed; its spheres stay in the cells that they had.
TEST(MapField, TheGridStrainsWithTheSample) {
    Config config;
    config.packing.blocks = {1, 4, 1};
    config.packing.block = Vec3(0.5, 0.25, 0.5);
    config.field.variable = randomfield::Variable::stiffness;
    Sample sample{stacked().spheres, *stacked().box};
    Sample compressed = sample;
    const double share = 0.86;
    compressed.box.upper.y() = compressed.box.lower.y() + share * compressed.box.size().y();
    for (double& y : compressed.spheres.position.y)
        y = compressed.box.lower.y() + share * (y - compressed.box.lower.y());
    map_field(config, 0, sample);
    map_field(config, 0, compressed);
    EXPECT_EQ(compressed.spheres.normal_stiffness, sample.spheres.normal_stiffness);
}

TEST(BoxOfPacking, WallsStartAtTheSpheresOfForeignFiles) {
    for (const double lid : {1.0, 1.1, 2.0}) {
        core::SphereFile file = stacked();
        file.box->upper.y() = lid;
        std::string note;
        const core::Box box = box_of_packing(file, &note);
        EXPECT_EQ(box.lower, Vec3(0, 0, 0));
        EXPECT_EQ(box.upper, Vec3(0.5, 1, 0.5));
        EXPECT_EQ(note.empty(), lid == 1.0) << note;
    }
    for (const char* kind : {"packing", "start", "state"}) {
        core::SphereFile file = stacked(kind);
        file.box->upper.y() = 1.01;  // below its lid there is room
        EXPECT_EQ(box_of_packing(file).upper.y(), 1.01);
        file.box->upper.y() = 1.5;
        EXPECT_EQ(box_of_packing(file).upper.y(), 1.0);
    }
}

}  // namespace
}  // namespace grainfield::triaxial
