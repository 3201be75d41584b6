// Files in other units than SI are converted, or refused, or spoken of; a grain of 1 cm never
// becomes one of 1 m without a word.

#include <gtest/gtest.h>

#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

struct System {
    std::string name;
    double length, density;  ///< to m, to kg/m3 [-]
};
const System cgs{"cgs", 1e-2, 1e3}, micro{"micro", 1e-6, 1e3}, nano{"nano", 1e-9, 1e6};

LammpsForm form_in(const System& units, const std::string& title) {
    return {.title = title, .length_unit = units.length, .density_unit = units.density};
}

TEST(Units, ThatTheFileNamesAreConverted) {
    const Workplace place;
    const core::ParticleStore& s = packing().spheres;
    for (const System& units : {cgs, micro, nano})
        for (const std::string& title :
             {"timestep = 20000, units = " + units.name, "poured, units " + units.name + "."}) {
            SCOPED_TRACE(title);
            const std::string file = place.write("P.data", lammps_text(form_in(units, title)));
            const Outcome outcome = place.run({"convert", file, place.path("P.h5")});
            ASSERT_EQ(outcome.code, 0) << outcome.err;
            EXPECT_TRUE(has(outcome.out, "units " + units.name + ": converted to SI"));
            const core::SphereFile back = core::read_spheres(place.path("P.h5"));
            for (const std::size_t i : {std::size_t{0}, std::size_t{627}}) {
                EXPECT_NEAR(back.spheres.radius[i] / s.radius[i], 1, 1e-12);
                EXPECT_NEAR(back.spheres.position.y[i] / s.position.y[i], 1, 1e-12);
                EXPECT_NEAR(back.spheres.mass[i] / (2600 * core::sphere_volume(s.radius[i])), 1,
                            1e-12);
            }
            EXPECT_NEAR(back.box->upper.y(), 0.5, 1e-12);
        }
}

// The same test as in SI, to the digits of the conversion.
TEST(Units, OfCentimetresAndGramsGiveTheSameTest) {
    const Workplace place;
    const auto stress = [&](const LammpsForm& form) {
        const Outcome outcome = shear(place, place.write("P.data", lammps_text(form)));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return place.json("run/summary.json").at("peak_deviator_stress_Pa").get<double>();
    };
    const double si = stress({});
    EXPECT_NEAR(stress(form_in(cgs, "units = cgs")), si, 0.01 * si);
}

TEST(Units, ThatHaveNoMetreOrAreNoneAreRefused) {
    const Workplace place;
    for (const char* name : {"lj", "real", "metal", "electron", "CGS", "imperial"}) {
        const std::string file =
            place.write("P.data", lammps_text({.title = "units = " + std::string(name)}));
        const Outcome outcome = place.run({"convert", file, place.path("P.csv")});
        EXPECT_EQ(outcome.code, 2) << name;
        EXPECT_TRUE(has(outcome.err, "must be si, cgs, micro or nano")) << outcome.err;
        EXPECT_FALSE(place.has("P.csv"));
    }
}

TEST(Units, ThatAreNotNamedAndCannotBeSiAreRefused) {
    const Workplace place;
    const System millimetres{"mm, kg/mm3", 1e-3, 1e9};
    for (const System& units : {cgs, micro, nano, millimetres}) {
        const std::string file =
            place.write("P.data", lammps_text(form_in(units, "poured on Monday")));
        for (const Outcome& outcome :
             {place.run({"info", file}), place.run({"convert", file, place.path("P.csv")}),
              shear(place, file)}) {
            EXPECT_EQ(outcome.code, 2) << units.name;
            EXPECT_TRUE(has(outcome.err, "are plausible: if other units are meant, name them"))
                << outcome.err;
        }
    }
}

// .csv and .txt are in metres; where that cannot be, it is said.
TEST(Units, OfTablesInMillimetresAreSpokenOf) {
    const Workplace place;
    for (const auto& [name, text] :
         {std::pair{"P.csv", "x,y,z,radius\n100,100,100,50\n300,100,100,50\n"},
          std::pair{"P.txt", "100 100 100 50\n300 100 100 50\n"}}) {
        const Outcome outcome = place.run({"info", place.write(name, text)});
        EXPECT_EQ(outcome.code, 0);
        EXPECT_TRUE(has(outcome.out, "the median radius is 50 m in SI")) << outcome.out;
    }
    const Outcome sound = place.run({"info", place.write("P.csv", csv_text())});
    EXPECT_FALSE(has(sound.out, "plausible")) << sound.out;
}

}  // namespace
}  // namespace grainfield::case_tests
