// The box in a file of another program is not always that of the sample.

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <sstream>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

class SampleBox : public testing::Test {
  protected:
    /// The hash of the final state, which is that of the whole run.
    std::string hash_of(const std::string& file) {
        outcome_ = shear(place_, file);
        EXPECT_EQ(outcome_.code, 0) << outcome_.err;
        return place_.json("run/summary.json").at("state_hash");
    }
    std::string hash_of(const LammpsForm& form) {
        return hash_of(place_.write("P.data", lammps_text(form)));
    }
    double porosity() const { return place_.json("run/summary.json").at("porosity").get<double>(); }

    Workplace place_;
    Outcome outcome_;
};

// A lid at 1 m once gave a tenth of the strength.
TEST_F(SampleBox, OfAnyHeightGivesOneResult) {
    const std::string expected = hash_of(LammpsForm{});
    EXPECT_FALSE(has(outcome_.err, "walls start at the spheres"));
    EXPECT_NEAR(porosity(), 0.400, 0.001);
    for (const double lid : {0.55, 0.6, 1.0, 20.0}) {
        EXPECT_EQ(hash_of(LammpsForm{.lid = lid}), expected) << lid;
        EXPECT_TRUE(has(outcome_.err, "the file's box is up to")) << outcome_.err;
    }
}

TEST_F(SampleBox, ThatIsWiderAlongAnyAxisOrHasAFloorBelowTheSpheresIsTrimmed) {
    const std::string expected = hash_of(LammpsForm{});
    const std::string text = lammps_text({});
    for (const auto& [bounds, others] : {std::pair{"0 0.25 xlo xhi", "-0.3 0.25 xlo xhi"},
                                         std::pair{"0 0.5 ylo yhi", "-0.2 0.5 ylo yhi"},
                                         std::pair{"0 0.25 zlo zhi", "-1 2 zlo zhi"}}) {
        std::string other = text;
        other.replace(other.find(bounds), std::string(bounds).size(), others);
        EXPECT_EQ(hash_of(place_.write("P.data", other)), expected) << others;
    }
}

TEST_F(SampleBox, IsTrimmedInOtherFormatsToo) {
    const std::string file = place_.write("P.data", lammps_text({.lid = 0.8}));
    const std::string expected = hash_of(LammpsForm{});
    ASSERT_EQ(place_.run({"convert", file, place_.path("P.h5")}).code, 0);
    EXPECT_EQ(hash_of(place_.path("P.h5")), expected);
    std::string dump =
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n628\nITEM: BOX BOUNDS ff ff ff\n0 0.25\n0 0.9\n"
        "0 0.25\nITEM: ATOMS id radius x y z\n";
    const core::ParticleStore& s = packing().spheres;
    for (std::size_t i = 0; i < s.size(); ++i)
        dump += fmt::format("{} {} {} {} {}\n", i + 1, s.radius[i], s.position.x[i],
                            s.position.y[i], s.position.z[i]);
    hash_of(place_.write("P.dump", dump));
    EXPECT_NEAR(porosity(), 0.400, 0.001);
    EXPECT_TRUE(has(outcome_.err, "walls start at the spheres"));
}

// As periodic samples have it: the spheres stand half outside.
TEST_F(SampleBox, ThatIsSmallerThanTheSpheresIsToldOf) {
    const std::string expected = hash_of(LammpsForm{});
    EXPECT_EQ(hash_of(LammpsForm{.lid = 0.49}), expected);
    EXPECT_TRUE(has(outcome_.err, "out of the file's box, as in a periodic one")) << outcome_.err;
}

TEST_F(SampleBox, WithAStraySphereFarAboveIsToldToBeNoPacking) {
    hash_of(LammpsForm{.lid = 1.3, .more_rows = {"629 1 0.02 2600 0.12 1.2 0.12"}});
    EXPECT_TRUE(has(outcome_.err, "this is no packing yet")) << outcome_.err;
}

}  // namespace
}  // namespace grainfield::case_tests
