// From file and --set to a Config.
#include "triaxial/config/load_config.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/config/changed_config.hpp"
#include "tests/config/config_equality.hpp"
#include "tests/config/config_fixture.hpp"
#include "triaxial/config/config_keys.hpp"
#include "triaxial/config/toml_text.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using Overrides = std::vector<std::string>;

class LoadConfig : public ConfigTest {};

/// The values of Tran et al. (docs/method.md).
constexpr std::string_view papers_text = R"(
[grading]
sieve_diameter = [0.010, 0.020, 0.040, 0.100, 0.160, 0.200]   # m
passing        = [0, 0, 31.47, 90.93, 99.64, 100]             # % by mass
[packing]
seed = 1
block = [0.25, 0.25, 0.25]      # m
blocks = [6, 12, 6]
porosity = 0.40
gravity = 9.81                  # m/s2, along -y
[particle]
density = 2600                  # kg/m3
normal_stiffness = 9e8          # Pa
stiffness_ratio = 0.1           # ks/kn
friction_angle = 0.6            # rad
[damping]
force = 0.2
moment = 0.2
[wall]
friction_angle = 0
poisson_ratio = 0.2
[field]
variable = "none"
method = "las"
seed = 1
correlation_length = [10.0, 1.0, 10.0]
[field.friction]
minimum = 0.3
maximum = 0.9
s = 2.0
[field.stiffness]
mean = 9e8
cov = 0.8
[triaxial]
confining_stress = 100e3
strain_rate = 0.1
max_axial_strain = "auto"
gravity = 0
[time]
step = "auto"
safety = 0.8
mass_scaling = 1.0
[solver]
precision = "mixed"
isa = "auto"
[montecarlo]
realizations = 250
deterministic = true
)";

TEST_F(LoadConfig, DefaultsAreThePapers) {
    const Config papers = load_config(write("paper.toml", papers_text));
    expect_equal(Config{}, papers);
    expect_equal(load_config(std::nullopt), papers);
    expect_equal(load_config(write("empty.toml", "")), papers);
    expect_equal(load_config(write("comment.toml", "# nothing\n[packing]\n")), papers);
}

/// The first block of TOML in docs/interface.md ("Config keys").
std::string documented_config() {
    std::ifstream stream(GRAINFIELD_SOURCE_DIR "/docs/interface.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    const std::string fence = "```toml\n";
    const std::size_t begin = page.find(fence) + fence.size();
    return page.substr(begin, page.find("```", begin) - begin);
}

TEST_F(LoadConfig, TheInterfaceDocumentsEveryKeyWithItsDefault) {
    const std::string text = documented_config();
    expect_equal(load_config(write("documented.toml", text)), Config{});
    Config config;
    for (const ConfigKey& key : config_keys(config))
        EXPECT_THAT(text, HasSubstr(key.path.substr(key.path.rfind('.') + 1))) << key.path;
}

TEST_F(LoadConfig, ReadsEveryKey) {
    expect_equal(load_config(write("changed.toml", changed_text)), changed_config());
}

TEST_F(LoadConfig, TheChangedTextChangesEveryKey) {
    Config defaults, changed = changed_config();
    const Keys before = config_keys(defaults), after = config_keys(changed);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i].path == "packing.relative_density") continue;
        const auto a = before[i].slot.get(), b = after[i].slot.get();
        EXPECT_FALSE((a != nullptr) == (b != nullptr) && (!a || toml_text(*a) == toml_text(*b)))
            << before[i].path;
    }
}

TEST_F(LoadConfig, DensityIsAskedForOnce) {
    const auto file = write("dense.toml", "[packing]\nrelative_density = 0.7\n");
    EXPECT_EQ(load_config(file).packing.relative_density, 0.7);
    const auto twice =
        write("twice.toml", "[packing]\nrelative_density = 0.7\ncompaction_friction = 0.1\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(twice); }),
                HasSubstr("packing.compaction_friction = 0.1: each sets the density: not beside "
                          "packing.relative_density"));
    const auto denser = write("denser.toml", "[packing]\nrelative_density = 1.1\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(denser); }), HasSubstr("in [0, 1]"));
}

TEST_F(LoadConfig, FilesThatCannotBeReadAreNamed) {
    EXPECT_THAT(message_of<FileError>([] { load_config("nowhere.toml"); }),
                "cannot read nowhere.toml: No such file or directory");
    EXPECT_THAT(message_of<FileError>([&] { load_config(folder_); }),
                HasSubstr("it is a directory"));
    EXPECT_THAT(message_of<FileError>([] { load_config("/dev/zero"); }), HasSubstr("16 MiB"));
}

TEST_F(LoadConfig, SyntaxErrorsHaveLineAndColumn) {
    const auto file = write("broken.toml", "[packing]\nseed = = 3\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(file); }),
                StartsWith(file.string() + ":2:8: not valid TOML: "));
    const auto twice = write("twice.toml", "[packing]\nseed = 1\nseed = 2\n");
    EXPECT_THAT(message_of<InputError>([&] { load_config(twice); }),
                StartsWith(twice.string() + ":3:"));
    const auto binary = write("binary.toml", std::string_view("\x89HDF\r\n\x1a\n\0\0", 10));
    EXPECT_THAT(message_of<InputError>([&] { load_config(binary); }),
                StartsWith(binary.string() + ":1:"));
}

TEST_F(LoadConfig, SettingsGoOverTheFileAndLaterOnesOverEarlier) {
    const auto file = write("a.toml", "[packing]\nporosity = 0.5\nseed = 3\n");
    const Overrides settings{"packing.porosity=0.6",           " packing.porosity = 0.45 ",
                             "field.variable=friction",        "solver.isa=scalar",
                             "field.friction={minimum=0.25}",  "field.friction.s=1",
                             "packing.blocks=[1, 2, 3]",       "time.step=\"auto\"",
                             "triaxial.max_axial_strain=auto", "montecarlo.deterministic=false"};
    Config expected;
    expected.packing.seed = 3;
    expected.packing.porosity = 0.45;
    expected.packing.blocks = {1, 2, 3};
    expected.field.variable = randomfield::Variable::friction;
    expected.field.friction.minimum = 0.25;
    expected.field.friction.s = 1;
    expected.solver.isa = kernels::InstructionSet::scalar;
    expected.montecarlo.deterministic = false;
    expect_equal(load_config(file, settings), expected);
}

// A file's data lie beside it; those of --set in the current folder; a resolved config is the same
// wherever it is read from.
TEST_F(LoadConfig, DataAreFoundFromTheFileThatNamesThem) {
    const auto file = write("a.toml", "[field]\ndata = \"sub/../cpt.csv\"\n");
    EXPECT_EQ(load_config(file).field.data, (folder_ / "cpt.csv").string());
    const auto absolute = write("b.toml", "[field]\ndata = \"/data/cpt.csv\"\n");
    EXPECT_EQ(load_config(absolute).field.data, "/data/cpt.csv");
    EXPECT_EQ(load_config(file, Overrides{"field.data=cpt.csv"}).field.data,
              (std::filesystem::current_path() / "cpt.csv").string());
    EXPECT_EQ(load_config(std::nullopt, Overrides{"field.data=/data/b.csv"}).field.data,
              "/data/b.csv");
}

TEST(ConfigValidate, ChecksWhatNoFileChecked) {
    EXPECT_NO_THROW(Config{}.validate());
    Config config;
    config.particle.density = -1;
    EXPECT_EQ(message_of<InputError>([&] { config.validate(); }),
              "particle.density = -1: a number > 0 is expected");
    config = {};
    config.triaxial.strain_rate = std::nan("");
    EXPECT_THAT(message_of<InputError>([&] { config.validate(); }),
                StartsWith("triaxial.strain_rate = nan"));
    config = {};
    config.solver.isa = static_cast<kernels::InstructionSet>(17);
    EXPECT_THAT(message_of<InputError>([&] { config.validate(); }), StartsWith("solver.isa"));
    config = {};
    config.packing.seed = ~std::uint64_t{0};  // TOML could not hold it
    EXPECT_THAT(message_of<InputError>([&] { config.validate(); }), StartsWith("packing.seed"));
    config = {};
    config.grading.passing[1] = 50;
    EXPECT_THAT(message_of<InputError>([&] { config.validate(); }), StartsWith("grading.passing"));
}

}  // namespace
}  // namespace grainfield::triaxial
