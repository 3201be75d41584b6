// Every message about bad input says file, line, key, value and what is allowed.
#include <gmock/gmock.h>

#include <tuple>
#include <vector>

#include "tests/config/config_fixture.hpp"
#include "triaxial/config/load_config.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class BadValues : public ConfigTest {};

struct BadValue {
    const char* table;
    const char* key;
    const char* value;    ///< TOML, in the spelling of messages
    const char* allowed;  ///< in the message
};

// clang-format off
const std::vector<BadValue> bad_values{
    {"grading", "sieve_diameter", "[0.02]", "2 or more numbers > 0"},
    {"grading", "sieve_diameter", "[0, 0.02]", "2 or more numbers > 0"},
    {"grading", "sieve_diameter", "[0.01, 0.02, 0.02, 0.1, 0.16, 0.2]", "overlapping sieve sizes"},
    {"grading", "sieve_diameter", "[0.01, 0.04, 0.02, 0.1, 0.16, 0.2]", "overlapping sieve sizes"},
    {"grading", "passing", "[0, 50, 100]", "6 numbers"},
    {"grading", "passing", "[0, 101]", "in [0, 100]"},
    {"grading", "passing", "[0, 40, 30, 90, 99, 100]", "never fall"},
    {"grading", "passing", "[1, 2, 30, 90, 99, 100]", "start at 0"},
    {"grading", "passing", "[0, 2, 30, 90, 99, 99.5]", "end at 100"},
    {"packing", "seed", "-1", "a whole number >= 0"},
    {"packing", "seed", "1.5", "a whole number >= 0"},
    {"packing", "block", "[0.25, 0.25]", "3 numbers > 0"},
    {"packing", "block", "[0.25, 0, 0.25]", "3 numbers > 0"},
    {"packing", "block", "[0.25, inf, 0.25]", "3 numbers > 0"},
    {"packing", "block", "0.25", "3 numbers > 0"},
    {"packing", "blocks", "[6, 0, 6]", "3 whole numbers in [1, 2147483647]"},
    {"packing", "blocks", "[6, 1.5, 6]", "3 whole numbers"},
    {"packing", "blocks", "[6, 12, 4294967297]", "3 whole numbers"},
    {"packing", "blocks", "[65536, 65536, 1]", "fewer than 2^31 blocks"},
    {"packing", "porosity", "\"dense\"", "a number in (0.2, 0.9)"},
    {"packing", "porosity", "0.2", "a number in (0.2, 0.9)"},
    {"packing", "porosity", "0.9", "a number in (0.2, 0.9)"},
    {"packing", "porosity", "nan", "a number in (0.2, 0.9)"},
    {"packing", "porosity", "true", "a number in (0.2, 0.9)"},
    {"packing", "porosity", "{ a = 1 }", "a number in (0.2, 0.9)"},
    {"packing", "gravity", "0", "a number > 0"},
    {"packing", "spheres", "0", "a whole number in [1, 2147483647]"},
    {"packing", "isotropic_stress", "-5", "a number > 0"},
    {"particle", "density", "0", "a number > 0"},
    {"particle", "normal_stiffness", "0", "a number > 0"},
    {"particle", "normal_stiffness", "inf", "a number > 0"},
    {"particle", "stiffness_ratio", "-0.1", "a number >= 0"},
    {"particle", "friction_angle", "1.5708", "in [0, pi/2)"},
    {"particle", "friction_angle", "-0.1", "in [0, pi/2)"},
    {"damping", "force", "1", "in [0, 1)"},
    {"damping", "moment", "-0.1", "in [0, 1)"},
    {"wall", "friction_angle", "30", "in [0, pi/2)"},
    {"wall", "poisson_ratio", "-0.2", "in [0, 1]"},
    {"field", "variable", "\"cohesion\"", "one of \"none\", \"friction\", \"stiffness\", \"both\""},
    {"field", "variable", "1", "one of"},
    {"field", "method", "\"LAS\"", "one of \"las\", \"las-classic\", \"cholesky\""},
    {"field", "correlation", "\"gauss\"", "one of \"markov\", \"separable-markov\""},
    {"field", "seed", "\"one\"", "a whole number >= 0"},
    {"field", "correlation_length", "[10, 0, 10]", "3 numbers > 0"},
    {"field", "stage0_cells", "0", "a whole number >= 1"},
    {"field", "cross_correlation", "1.5", "in [-1, 1]"},
    {"field", "cross_correlation", "nan", "no negative eigenvalue"},
    {"field", "data", "3", "the name of a CSV file"},
    {"field", "data", "\"\"", "the name of a CSV file"},
    {"field", "data_deviations", "0", "a number > 0"},
    {"field.friction", "marginal", "\"gamma\"", "\"bounded\", \"lognormal\", \"normal\""},
    {"field.friction", "marginal", "0", "one of"},
    {"field.friction", "mean", "1.6", "in (0, pi/2)"},
    {"field.friction", "cov", "0", "a number in [1e-6, 1000]"},
    {"field.friction", "mean_gradient", "inf", "a number is expected"},
    {"field.friction", "mean_gradient", "0.3", "height of 0.125 m: field.friction.minimum = -0.11"},
    {"field.stiffness", "marginal", "\"beta\"", "needs field.stiffness.minimum"},
    {"field.stiffness", "minimum", "0", "a number in [1e-100, 1e100]"},
    {"field.friction", "minimum", "-0.3", "in [0, pi/2)"},
    {"field.friction", "maximum", "2", "in [0, pi/2)"},
    {"field.friction", "s", "0", "a number in [1e-6, 1e6]"},
    {"field.stiffness", "mean", "0", "a number in [1e-100, 1e100]"},
    {"field.stiffness", "cov", "-0.8", "a number in [1e-6, 1000]"},
    {"field.stiffness", "cov", "1e-300", "a number in [1e-6, 1000]"},
    {"field.stiffness", "mean", "1e300", "a number in [1e-100, 1e100]"},
    {"field.friction", "s", "1e300", "a number in [1e-6, 1e6]"},
    {"field.stiffness", "preserve_mean", "1", "true or false"},
    {"triaxial", "confining_stress", "0", "a number > 0"},
    {"triaxial", "strain_rate", "-0.1", "a number > 0"},
    {"triaxial", "max_axial_strain", "0", "\"auto\" or a number in (0, 0.5]"},
    {"triaxial", "max_axial_strain", "0.6", "\"auto\" or a number in (0, 0.5]"},
    {"triaxial", "max_axial_strain", "\"peak\"", "\"auto\" or a number in (0, 0.5]"},
    {"triaxial", "gravity", "-9.81", "a number >= 0"},
    {"time", "step", "0", "\"auto\" or a number > 0"},
    {"time", "step", "\"fast\"", "\"auto\" or a number > 0"},
    {"time", "safety", "1", "in (0, 1)"},
    {"time", "safety", "0", "in (0, 1)"},
    {"time", "mass_scaling", "0.5", "a number >= 1"},
    {"solver", "precision", "\"single\"", "one of \"double\", \"mixed\""},
    {"solver", "isa", "\"neon\"", "one of \"auto\", \"scalar\", \"avx2\", \"avx512\""},
    {"montecarlo", "realizations", "0", "a whole number in [1, 2147483647]"},
    {"montecarlo", "deterministic", "\"yes\"", "true or false"},
};
// clang-format on

TEST_F(BadValues, InAFileNameFileLineKeyValueAndWhatIsAllowed) {
    for (const auto& [table, key, value, allowed] : bad_values) {
        SCOPED_TRACE(std::string(table) + "." + key + " = " + value);
        const auto file = write("bad.toml", std::string("# a comment\n\n[") + table + "]\n" + key +
                                                " = " + value + "\n");
        const std::string message = message_of<InputError>([&] { load_config(file); });
        EXPECT_THAT(message, StartsWith(file.string() + ":4: " + table + "."));
        EXPECT_THAT(message, HasSubstr(std::string(key) + " = " + value));
        EXPECT_THAT(message, HasSubstr(allowed));
        EXPECT_THAT(message.substr(file.string().size()), Not(HasSubstr("/tmp")));
        EXPECT_THAT(message, Not(HasSubstr(GRAINFIELD_SOURCE_DIR)));
    }
}

TEST_F(BadValues, OnTheCommandLineNameTheSetting) {
    for (const auto& [table, key, value, allowed] : bad_values) {
        const std::string setting = std::string(table) + "." + key + "=" + value;
        SCOPED_TRACE(setting);
        const std::vector<std::string> settings{setting};
        const std::string message =
            message_of<InputError>([&] { load_config(std::nullopt, settings); });
        EXPECT_THAT(message, StartsWith("--set " + setting + ": " + table + "."));
        EXPECT_THAT(message, HasSubstr(allowed));
    }
}

TEST_F(BadValues, TheWholeMessage) {
    const auto file = write("paper.toml", "[packing]\nseed = 2\nporosity = 'dense'\n");
    EXPECT_EQ(
        message_of<InputError>([&] { load_config(file); }),
        file.string() + ":3: packing.porosity = \"dense\": a number in (0.2, 0.9) is expected");
}

TEST_F(BadValues, ALongValueIsCut) {
    const auto file = write("a.toml", "[solver]\nisa = \"" + std::string(100'000, 'x') + "\"\n");
    EXPECT_LT(message_of<InputError>([&] { load_config(file); }).size(), 500U);
}

TEST_F(BadValues, OfOtherKindsThanATable) {
    const auto file = write("a.toml", "packing = 3\n");
    EXPECT_EQ(message_of<InputError>([&] { load_config(file); }),
              file.string() + ":1: packing = 3: a table is expected");
    const std::vector<std::string> settings{"packing.seed=2"};
    EXPECT_EQ(message_of<InputError>([&] { load_config(file, settings); }),
              "--set packing.seed=2: packing is not a table in " + file.string() + ":1");
    const auto array = write("b.toml", "[[packing]]\nseed = 1\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(array); }),
                StartsWith(array.string() + ":1: packing = [{ seed = 1 }]: a table"));
    const auto date = write("c.toml", "[packing]\nseed = 2020-01-01\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(date); }),
                StartsWith(date.string() + ":2: packing.seed = a date: a whole number"));
}

TEST_F(BadValues, UnknownKeysGetTheNearestName) {
    // Text, line of the key, what follows.
    const std::vector<std::tuple<const char*, int, const char*>> cases{
        {"[packing]\nseed = 1\nporosty = 0.4\n", 3,
         "packing.porosty is not a known key; did you mean packing.porosity?"},
        {"[pakcing]\nporosity = 0.4\n", 1, "pakcing is not a known key; did you mean packing?"},
        {"[pakcing]\n", 1, "pakcing is not a known key; did you mean packing?"},
        {"porosity = 0.4\n", 1, "porosity is not a known key; did you mean packing.porosity?"},
        {"[field]\nminimum = 0.4\n", 2,
         "field.minimum is not a known key; did you mean field.friction.minimum?"},
        {"[field.friction]\nmax = 0.4\n", 2, "field.friction.max is not a known key"},
        {"\"packing.seed\" = 2\n", 1,
         "\"packing.seed\" is not a known key; did you mean packing.seed?"},
        {"[packing.extra]\na = 1\n", 1, "packing.extra is not a known key"},
        {"[[wall]]\n", 1, "wall = [{}]: a table is expected"},
        {"zzz = 1\n", 1, "zzz is not a known key"},
    };
    for (const auto& [text, line, rest] : cases) {
        const auto file = write("a.toml", text);
        EXPECT_EQ(message_of<InputError>([&] { load_config(file); }),
                  file.string() + ":" + std::to_string(line) + ": " + rest);
    }
}

TEST_F(BadValues, SettingsThatAreNone) {
    const std::vector<std::pair<const char*, const char*>> cases{
        {"packing.porosty=0.4", "packing.porosty is not a known key; did you mean"},
        {"packing.porosity", "key.path=value is expected"},
        {"packing.porosity=", "key.path=value is expected"},
        {"=3", "key.path=value is expected"},
        {"", "key.path=value is expected"},
        {"#packing.seed=3", "key.path=value is expected"},
        {"packing.seed=3\ntime.safety=0.5", "key.path=value is expected"},
        {"packing..seed=3", "is not a key: key.path=value is expected"},
        {"[packing]=3", "is not a key: key.path=value is expected"},
        {"packing.blocks=[1,2", "the value is not valid TOML"},
        {"packing.seed=1 2", "the value is not valid TOML"},
        {"packing=3", "packing = 3: a table is expected"},
    };
    for (const auto& [setting, rest] : cases) {
        const std::vector<std::string> settings{setting};
        const std::string message =
            message_of<InputError>([&] { load_config(std::nullopt, settings); });
        EXPECT_THAT(message, StartsWith(std::string("--set ") + setting + ": "));
        EXPECT_THAT(message, HasSubstr(rest));
    }
}

TEST_F(BadValues, AtOddsWithADefaultNameTheLineThatIsThere) {
    const auto file = write("a.toml", "[grading]\npassing = [0, 50, 100]\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(file); }),
                StartsWith(file.string() + ":2: grading.passing = [0, 50, 100]: 6 numbers"));
    const auto sieves = write("b.toml", "[grading]\nsieve_diameter = [0.1, 0.2]\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(sieves); }),
                StartsWith(sieves.string() + ":2: grading.passing = ["));
    const auto angles = write("c.toml", "[field.friction]\nminimum = 0.95\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(angles); }),
                StartsWith(angles.string() + ":2: field.friction.maximum = 0.9: "));
}

}  // namespace
}  // namespace grainfield::triaxial
