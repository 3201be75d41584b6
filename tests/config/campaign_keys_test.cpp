// A config with a campaign loads for every subcommand; mistakes in it come out at once.
#include <gmock/gmock.h>

#include <vector>

#include "tests/config/config_equality.hpp"
#include "tests/config/config_fixture.hpp"
#include "triaxial/config/load_config.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class Campaign : public ConfigTest {};

TEST_F(Campaign, OfTheContractLoadsAndLeavesTheRunAlone) {
    const auto file = write("campaign.toml", R"(
[montecarlo]
realizations = 20
[montecarlo.sweep]
"field.stiffness.cov" = [0.4, 0.8, 1.2, 1.6, 2.0]
"triaxial.confining_stress" = [100e3, 200e3]
field.correlation_length = [[10, 1, 10], [5.0, 0.5, 5.0]]
[[montecarlo.case]]
name = "A-0.5"
set = { "field.variable" = "friction", "field.correlation_length" = [5.0, 0.5, 5.0] }
[[montecarlo.case]]
name = "B"
set.field.variable = "stiffness"
[[montecarlo.case]]
name = "base"
)");
    Config expected;
    expected.montecarlo.realizations = 20;
    expect_equal(load_config(file), expected);
}

TEST_F(Campaign, NamesThatFilesAndColumnsCannotHaveAreRefused) {
    const auto refusal = [&](const std::string& text) {
        const auto file = write("a.toml", text);
        return message_of<InputError>([&] { load_campaign(file); });
    };
    for (const char* value : {"a,b", "a/b.csv", "../a", "a\\nb", "a\\\"b", "<b>"})
        EXPECT_THAT(
            refusal("[montecarlo.sweep]\n'field.data' = [\"" + std::string(value) + "\"]\n"),
            HasSubstr("montecarlo.sweep: a case would be called \"data="))
            << value;
    EXPECT_THAT(refusal("[[montecarlo.case]]\nname = ''\n"), HasSubstr("a text is expected"));
    EXPECT_THAT(refusal("[[montecarlo.case]]\nname = '" + std::string(201, 'a') + "'\n"),
                HasSubstr("a name of at most 200"));
    const std::string two =
        "[[montecarlo.case]]\nname = 'a b'\n[[montecarlo.case]]\nname = 'a_b'\n";
    EXPECT_THAT(refusal(two), HasSubstr("\"a_b\" would share its files with another one"));
    std::string many = "[montecarlo.sweep]\n";
    for (const char* key : {"particle.density", "particle.friction_angle", "packing.porosity"}) {
        many += "'" + std::string(key) + "' = [";
        for (int k = 1; k <= 40; ++k) many += (k > 1 ? ", 0.3" : "0.3") + std::to_string(k);
        many += "]\n";
    }
    EXPECT_THAT(refusal(many), HasSubstr("64000 cases or more: at most 10000 are allowed"));
}

TEST_F(Campaign, MistakesNameLineAndKey) {
    struct Mistake {
        const char* text;  ///< under [montecarlo], from line 2
        int line;
        const char* message;
    };
    const std::vector<Mistake> mistakes{
        {"realisations = 3", 2, "montecarlo.realisations is not a known key; did you mean"},
        {"sweep = 3", 2, "montecarlo.sweep = 3: a table"},
        {"sweep = { 'field.stiffness.cof' = [1] }", 2,
         "\"field.stiffness.cof\" is not a known key in montecarlo.sweep; did you mean "
         "\"field.stiffness.cov\"?"},
        {"[montecarlo.sweep]\n'field.stiffness.cov' = 0.4", 3,
         "montecarlo.sweep.\"field.stiffness.cov\" = 0.4: an array of one or more values"},
        {"[montecarlo.sweep]\n'field.stiffness.cov' = []", 3, "an array of one or more values"},
        {"[montecarlo.sweep]\n'field.stiffness.cov' = [\n0.4,\n-1]", 5,
         "montecarlo.sweep.\"field.stiffness.cov\" = -1: a number in [1e-6, 1000] is expected"},
        {"[montecarlo.sweep]\n'montecarlo.realizations' = [1, 2]", 3,
         "\"montecarlo.realizations\" is not a known key in montecarlo.sweep"},
        {"case = 'A'", 2, "montecarlo.case = \"A\": an array of tables"},
        {"[[montecarlo.case]]\nset = {}", 2, "montecarlo.case.name is missing: a text"},
        {"[[montecarlo.case]]\nname = 3", 3, "montecarlo.case.name = 3: a text"},
        {"[[montecarlo.case]]\nname = 'A'\n[[montecarlo.case]]\nname = 'A'", 5,
         "montecarlo.case.name = \"A\": a name of its own"},
        {"[[montecarlo.case]]\nname = 'A'\nsett = {}", 4,
         "montecarlo.case.sett is not a known key; did you mean montecarlo.case.set?"},
        {"[[montecarlo.case]]\nname = 'A'\nset = 3", 4, "montecarlo.case.set = 3: a table"},
        {"[[montecarlo.case]]\nname = 'A'\nset = { 'time.safety' = 2 }", 4,
         "montecarlo.case.set.\"time.safety\" = 2: a number in (0, 1) is expected"},
        {"[[montecarlo.case]]\nname = 'A'\nset = { 'time.savety' = 2 }", 4,
         "\"time.savety\" is not a known key in montecarlo.case.set; did you mean "
         "\"time.safety\"?"},
    };
    for (const auto& [text, line, message] : mistakes) {
        const auto file = write("a.toml", std::string("[montecarlo]\n") + text + "\n");
        const std::string found = message_of<InputError>([&] { load_config(file); });
        EXPECT_THAT(found, StartsWith(file.string() + ":" + std::to_string(line) + ": "));
        EXPECT_THAT(found, HasSubstr(message));
    }
}

}  // namespace
}  // namespace grainfield::triaxial
