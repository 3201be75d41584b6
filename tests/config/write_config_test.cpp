// The resolved config gives back the same run.
#include "triaxial/config/write_config.hpp"

#include <gmock/gmock.h>
#include <toml++/toml.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tests/config/changed_config.hpp"
#include "tests/config/config_equality.hpp"
#include "tests/config/config_fixture.hpp"
#include "triaxial/config/load_config.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;

class WriteConfig : public ConfigTest {};

TEST_F(WriteConfig, RoundTripsFieldByField) {
    for (const Config& config : {Config{}, changed_config()}) {
        const std::string text = write_config(config);
        const Config back = load_config(write("config.toml", text));
        expect_equal(back, config);
        EXPECT_EQ(write_config(back), text);
    }
}

TEST_F(WriteConfig, KeepsNumbersThatAreHardToPrint) {
    Config config;
    config.particle.density = 0.1 + 0.2;
    config.particle.normal_stiffness = std::nextafter(9e8, 1e9);
    config.triaxial.confining_stress = std::numeric_limits<double>::max();
    config.time.step = std::numeric_limits<double>::min();
    config.packing.seed = std::numeric_limits<std::int64_t>::max();
    config.packing.gravity = 9007199254740993e3;
    expect_equal(load_config(write("config.toml", write_config(config))), config);
}

TEST_F(WriteConfig, ReadsLikeTheContract) {
    const std::string text = write_config(Config{});
    EXPECT_THAT(text, HasSubstr("\n[packing]\nseed = 1 "));
    EXPECT_THAT(text, HasSubstr("\nporosity = 0.4  # of the block\n"));
    EXPECT_THAT(text, HasSubstr("\nnormal_stiffness = 9e8  # Pa\n"));
    EXPECT_THAT(text, HasSubstr("\npassing = [0, 0, 31.47, 90.93, 99.64, 100]  # % by mass\n"));
    EXPECT_THAT(text, HasSubstr("\n[field.friction]\nminimum = 0.3  # rad: of \"bounded\""));
    EXPECT_THAT(text, HasSubstr("\nstep = \"auto\"  # s, or \"auto\"\n"));
    EXPECT_THAT(text, HasSubstr("\n# spheres is not set  # optional"));
    std::size_t at = 0;
    for (const char* table :
         {"grading", "packing", "particle", "damping", "wall", "field", "field.friction",
          "field.stiffness", "triaxial", "time", "solver", "montecarlo"}) {
        const std::size_t found = text.find(std::string("\n[") + table + "]\n");
        ASSERT_NE(found, std::string::npos) << table;
        EXPECT_GE(found, at) << table << " is out of order";
        at = found;
    }
}

TEST(TomlText, NumbersComeBackBitForBit) {
    std::mt19937_64 random(1);
    std::vector<double> numbers{0.0, -0.0, 1.0, 9e8, 1e-5, 1e15, 1e16, 1e17, 1e22, 0.1, 5e-324};
    for (int i = 0; i < 20'000; ++i) {
        const auto number = std::bit_cast<double>(random());
        if (std::isfinite(number)) numbers.push_back(number);
        numbers.push_back(static_cast<double>(random()) * 1e-3);
    }
    std::string text;
    for (const double number : numbers) text += number_text(number) + ", ";
    const toml::table document = parse_toml("a = [" + text + "]", "text");
    const toml::array& array = *document.get("a")->as_array();
    ASSERT_EQ(array.size(), numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto* whole = array[i].as_integer();
        const double back =
            whole ? static_cast<double>(whole->get()) : array[i].as_floating_point()->get();
        ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(numbers[i]))
            << number_text(numbers[i]);
    }
}

TEST(TomlText, NumbersAreShort) {
    EXPECT_EQ(number_text(9e8), "9e8");
    EXPECT_EQ(number_text(1e-5), "1e-5");
    EXPECT_EQ(number_text(1.5e-7), "1.5e-7");
    EXPECT_EQ(number_text(2600), "2600");
    EXPECT_EQ(number_text(100e3), "100000");
    EXPECT_EQ(number_text(31.47), "31.47");
    EXPECT_EQ(number_text(-std::numeric_limits<double>::max()), "-1.7976931348623157e308");
}

TEST(TomlText, StringsComeBack) {
    const std::string odd = "a \"b\" \\ \n \t \x01 \x7f \xc3\xa9";
    const toml::table document = parse_toml("a = " + toml_string(odd), "text");
    EXPECT_EQ(document.get("a")->as_string()->get(), odd);
}

}  // namespace
}  // namespace grainfield::triaxial
