// The formats of other programs: LAMMPS data files and YADE's text.

#include <gmock/gmock.h>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "tests/files/sample.hpp"

namespace grainfield::core {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class TextFormatsTest : public FilesTest {
  protected:
    std::string error(const std::string& name, const std::string& text) const {
        const auto path = text_file(name, text);
        const std::string message = message_of<InputError>([&] { read_spheres(path); });
        EXPECT_THAT(message, StartsWith(path.string()));
        return message.substr(message.find(name));
    }
};
class LammpsDataTest : public TextFormatsTest {};
class LammpsDumpTest : public TextFormatsTest {};
class YadeTextTest : public TextFormatsTest {};

SphereFile two_spheres() {
    SphereFile file;
    ParticleStore& s = file.spheres;
    s.resize(2);
    s.position.set(0, {0.25, 0.5, -1});
    s.position.set(1, {1e-7, 2, 3});
    s.velocity.set(1, {1, 2, 3});
    s.spin.set(1, {-4, 5, 6.5});
    s.radius = {0.5, 0.25};
    return file;
}

// The layout as https://docs.lammps.org/read_data.html gives it.
TEST_F(LammpsDataTest, HasTheDocumentedLayout) {
    SphereFile file = two_spheres();  // without mass: Tran et al.'s density
    file.box = Box{{-1, -2, -3}, {4, 5, 6.5}};
    file.has_velocity = true;
    write_spheres(in_folder("s.data"), file);
    EXPECT_EQ(read_whole_file(in_folder("s.data")),
              "LAMMPS data file of grainfield, atom_style sphere, units si\n\n"
              "2 atoms\n1 atom types\n\n"
              "-1 4 xlo xhi\n-2 5 ylo yhi\n-3 6.5 zlo zhi\n\n"
              "Atoms # sphere\n\n"
              "1 1 1 2600 0.25 0.5 -1\n2 1 0.5 2600 1e-07 2 3\n\n"
              "Velocities\n\n"
              "1 0 0 0 0 0 0\n2 1 2 3 -4 5 6.5\n");
    file.has_velocity = false;
    file.box.reset();
    write_spheres(in_folder("s.data"), file);
    const std::string text = read_whole_file(in_folder("s.data"));
    EXPECT_THAT(text, HasSubstr("\n-0.25 0.75 xlo xhi\n0 2.25 ylo yhi\n-1.5 3.25 zlo zhi\n"));
    EXPECT_THAT(text, testing::Not(HasSubstr("Velocities")));
}

TEST_F(LammpsDataTest, ComesBack) {
    const SphereFile sample = make_sample(400);
    write_spheres(in_folder("s.data"), sample);
    const SphereFile back = read_spheres(in_folder("s.data"));
    const ParticleStore& a = back.spheres;
    const ParticleStore& b = sample.spheres;
    EXPECT_TRUE(same_bits(a.position, b.position) && same_bits(a.radius, b.radius));
    EXPECT_TRUE(same_bits(a.velocity, b.velocity) && same_bits(a.spin, b.spin));
    ASSERT_TRUE(back.box && back.has_velocity);
    EXPECT_EQ(back.box->lower, sample.box->lower);
    EXPECT_EQ(back.box->upper, sample.box->upper);
    // Mass goes through a density and back: a division and a multiplication.
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a.mass[i] / b.mass[i], 1, 1e-15) << i;
}

// As LAMMPS' own write_data has it: image flags, other sections, atoms in any order.
TEST_F(LammpsDataTest, ReadsWhatLammpsWrites) {
    const SphereFile file = read_spheres(
        text_file("s.data",
                  "1 atoms in the first line mean nothing\n\n2 atoms\n1 atom types\n0 bonds\n\n"
                  "0 1.5e0 xlo xhi # comment\n0 3 ylo yhi\n-1 1.5 zlo zhi\n0 0 0 xy xz yz\n\n"
                  "Pair Coeffs # hertz\n\n1 2 3\n\nAtoms # sphere\n\n"
                  "9 1 0.02 1000 1 2 0.5 0 0 0\n4 1 0.01 2000 0.5 1 0.25 0 0 0 # mine\n\n"
                  "Velocities\n\n4 1 2 3 4 5 6\n9 0 0 0 0 0 -1\n"));
    ASSERT_EQ(file.spheres.size(), 2u);
    EXPECT_EQ(file.spheres.position[0], Vec3(0.5, 1, 0.25)) << "by atom id";
    EXPECT_EQ(file.spheres.velocity[0], Vec3(1, 2, 3));
    EXPECT_EQ(file.spheres.spin[1], Vec3(0, 0, -1));
    EXPECT_EQ(file.spheres.radius[1], 0.01);
    EXPECT_NEAR(file.spheres.mass[1], 1000 * 4.1887902047863909e-6, 1e-18);
    EXPECT_EQ(file.box->upper, Vec3(1.5, 3, 1.5));
    EXPECT_EQ(file.lines, (std::vector<std::int32_t>{19, 18}));
}

TEST_F(LammpsDataTest, NamesWhatIsWrong) {
    const auto say = [&](const std::string& text) { return error("s.data", text); };
    const std::string head =
        "title\n\n2 atoms\n1 atom types\n\nAtoms # sphere\n\n1 1 1 2600 0 0 0\n";
    EXPECT_EQ(say(""), "s.data:1: the file is empty");
    EXPECT_THAT(say("title\n"), HasSubstr("'N atoms' is missing"));
    EXPECT_EQ(say("title\n2 atoms\n"), "s.data:2: section Atoms is missing");
    EXPECT_EQ(say("title\n-2 atoms\n"), "s.data:2: header atoms = -2: must be an integer >= 0");
    EXPECT_EQ(say("title\n1.5 atoms\n"), "s.data:2: header atoms = 1.5: must be an integer >= 0");
    EXPECT_EQ(say("title\n1 0 xlo xhi\n"), "s.data:2: xlo xhi: the second must be larger");
    EXPECT_THAT(say("title\n3 bonds\n"),
                AllOf(HasSubstr("header '3 bonds': not supported; allowed: "),
                      HasSubstr("the atom style must be sphere")));
    EXPECT_THAT(say("title\n0 0 0.1 xy xz yz\n"), HasSubstr("not supported"));
    EXPECT_EQ(say(head), "s.data:8: section Atoms ends after 1 of 2 lines");
    EXPECT_EQ(say(head + "\nVelocities\n\n"), "s.data:10: section Atoms ends after 1 of 2 lines");
    EXPECT_EQ(say(head + "1 1 1 2600 0 0 0\n"), "s.data:9: section Atoms: atom-ID 1 stands twice");
    EXPECT_EQ(say(head + "2 1 0 2600 0 0 0\n"), "s.data:9: column diameter = 0: must be > 0 m");
    EXPECT_EQ(say(head + "2 1 1 -1 0 0 0\n"), "s.data:9: column density = -1: must be > 0 kg/m3");
    EXPECT_EQ(say(head + "2 1 1 1 0 nan 0\n"), "s.data:9: column y = nan: must be a finite number");
    EXPECT_EQ(say(head + "x 1 1 1 0 0 0\n"), "s.data:9: section Atoms ends after 1 of 2 lines");
    EXPECT_THAT(say(head + "2 1 1 1 0 0\n"), HasSubstr("atom-ID atom-type diameter density x y z"));
    const std::string both = head + "2 1 1 2600 0 0 0\n";
    EXPECT_EQ(say(both + "\nVelocities\n\n7 0 0 0 0 0 0\n"),
              "s.data:13: column atom-ID = 7: no such atom");
    EXPECT_THAT(say(both + "\nVelocities\n\n1 0 0 0\n"), HasSubstr("atom-ID vx vy vz wx wy wz"));
    EXPECT_THAT(say(both + "\nBonds\n\n1 1 1 2\n"),
                HasSubstr("section 'Bonds': not supported; allowed: Atoms, Velocities"));
    EXPECT_EQ(say(both + "\nAtoms\n\n3 1 1 2600 0 0 0\n"), "s.data:11: section Atoms stands twice");
    EXPECT_EQ(say("title\n1 atoms\n\nVelocities\n\n1 0 0 0 0 0 0\n"),
              "s.data:4: section Velocities must come after Atoms");
    EXPECT_THAT(say(both + "\nVelocities\n\n0.5 0 0 0 0 0 0\n"),
                HasSubstr("column atom-ID = 0.5: must be an integer >= 1"));
    EXPECT_THAT(say("title\n3e9 atoms\n"), HasSubstr("header atoms = 3000000000: must be an"));
    EXPECT_THAT(say("title\n0 1 2 xlo xhi\n"), HasSubstr("not supported"));
    EXPECT_THAT(say("title\n0\n"), HasSubstr("header '0': not supported"));
    EXPECT_THAT(say("title\n0 xlo xhi\n"), HasSubstr("column header = xlo: must be a finite"));
    EXPECT_EQ(say("title\n1 atoms\n\nMasses\n\n1 1\n"), "s.data:6: section Atoms is missing");
    EXPECT_EQ(say("title\n1 atoms\n\nAtoms # full\n\n"),
              "s.data:4: atom style 'full': must be sphere, granular, bpm/sphere or a hybrid with "
              "sphere, which have a diameter and a density");
}

/// Three grains as a user of cgs units has them, in the columns of a style.
std::string poured(const std::string& title, const std::string& style, bool positions_first) {
    std::string text = "LAMMPS data file via write_data, " + title +
                       "\n\n3 atoms\n1 atom types\n\n0 4 xlo xhi\n0 4 ylo yhi\n0 4 zlo "
                       "zhi\n\nAtoms" +
                       (style.empty() ? "" : " # " + style) + "\n\n";
    for (const auto& [ids, sizes, position] : {std::array{"1 1 ", "1.0 2.6 ", "1.0 0.5 1.0 "},
                                               std::array{"3 1 ", "1.0 2.6 ", "2.5 0.5 1.0 "},
                                               std::array{"7 1 ", "0.8 2.6 ", "1.5 1.3 1.0 "}})
        text += std::string(ids) + (positions_first ? position : sizes) +
                (positions_first ? sizes : position) + "0 0 0\n";
    return text + "\nVelocities\n\n1 100 0 0 0 0 7\n3 0 0 0 0 0 0\n7 0 0 0 0 0 0\n";
}

TEST_F(LammpsDataTest, UnitsOfTheFirstLineAreConvertedOrRefused) {
    struct System {
        const char* name;
        double length, density, velocity, spin;
    };
    for (const System& u : {System{"cgs", 1e-2, 1e3, 1e-2, 1}, System{"micro", 1e-6, 1e3, 1, 1e6},
                            System{"nano", 1e-9, 1e6, 1, 1e9}, System{"si", 1, 1, 1, 1}}) {
        SCOPED_TRACE(u.name);
        const SphereFile file = read_spheres(text_file(
            "s.data", poured("timestep = 20000, units = " + std::string(u.name), "sphere", false)));
        const ParticleStore& s = file.spheres;
        ASSERT_EQ(s.size(), 3u);
        EXPECT_DOUBLE_EQ(s.radius[0], 0.5 * u.length);
        EXPECT_DOUBLE_EQ(s.radius[2], 0.4 * u.length);
        EXPECT_DOUBLE_EQ(s.position.y[2], 1.3 * u.length);
        EXPECT_NEAR(s.mass[0] / (2.6 * u.density * 4.1887902047863909 * std::pow(s.radius[0], 3)),
                    1, 1e-14);
        EXPECT_DOUBLE_EQ(s.velocity.x[0], 100 * u.velocity);
        EXPECT_DOUBLE_EQ(s.spin.z[0], 7 * u.spin);
        EXPECT_DOUBLE_EQ(file.box->upper.x(), 4 * u.length);
        EXPECT_EQ(file.notes.size(), std::string(u.name) == "si" ? 0u : 1u);
    }
    for (const char* name : {"lj", "real", "metal", "electron"})
        EXPECT_THAT(error("s.data", poured("units = " + std::string(name), "sphere", false)),
                    AllOf(StartsWith("s.data:1: units " + std::string(name) + ": "),
                          HasSubstr("must be si, cgs, micro or nano")));
    EXPECT_THAT(error("s.data", poured("units = furlongs", "sphere", false)),
                HasSubstr("units furlongs: unknown"));
}

TEST_F(LammpsDataTest, NumbersThatSiCannotMeanAreRefusedWhereNoUnitsAreNamed) {
    EXPECT_THAT(error("s.data", poured("in units of my own", "sphere", false)),
                AllOf(StartsWith("s.data:1: the median density is 2.6 kg/m3 in SI"),
                      HasSubstr("name them in the first line ('units = cgs'")));
    const auto one = [](const char* diameter) {
        return std::string("t\n1 atoms\nAtoms # sphere\n\n1 1 ") + diameter + " 2600 0 0 0\n";
    };
    EXPECT_THAT(error("s.data", one("500")), HasSubstr("the median radius is 250 m in SI"));
    EXPECT_EQ(read_spheres(text_file("s.data", one("5"))).spheres.radius[0], 2.5);
}

TEST_F(LammpsDataTest, StylesAreKnownOrRefusedAndNeverGuessed) {
    const std::string cgs = "units = cgs";
    for (const auto& [style, first] :
         {std::pair{"sphere", false}, std::pair{"granular", false},
          std::pair{"hybrid sphere", true}, std::pair{"hybrid atomic sphere", true}}) {
        SCOPED_TRACE(style);
        const SphereFile file = read_spheres(text_file("s.data", poured(cgs, style, first)));
        ASSERT_EQ(file.spheres.size(), 3u);
        EXPECT_DOUBLE_EQ(file.spheres.radius[2], 0.004);
        EXPECT_EQ(file.spheres.position[1], Vec3(1e-2 * 2.5, 1e-2 * 0.5, 1e-2));
    }
    const SphereFile charged =
        read_spheres(text_file("s.data",
                               "units si\n1 atoms\nAtoms # hybrid charge sphere\n\n"
                               "1 1 0.1 0.2 0.3 -9 0.5 2600\n"));
    EXPECT_EQ(charged.spheres.radius[0], 0.25);
    EXPECT_EQ(charged.spheres.position[0], Vec3(0.1, 0.2, 0.3));
    const SphereFile bonded = read_spheres(text_file(
        "s.data", "units si\n1 atoms\nAtoms # bpm/sphere\n\n1 4 1 0.5 2600 0.1 0.2 0.3\n"));
    EXPECT_EQ(bonded.spheres.radius[0], 0.25);
    // The columns of sphere under the name of a hybrid: grains would overlap.
    EXPECT_THAT(error("s.data", poured(cgs, "hybrid sphere", false)),
                HasSubstr("the columns of this atom style are: atom-ID atom-type x y z diameter "
                          "density; those of sphere: atom-ID atom-type diameter density x y z"));
    EXPECT_THAT(
        error("s.data", poured(cgs, "", false)),
        AllOf(StartsWith("s.data:10: the atom style is not said"), HasSubstr("'Atoms # sphere'")));
    for (const char* style : {"full", "atomic", "ellipsoid", "hybrid full", "hybrid sphere body"})
        EXPECT_THAT(error("s.data", poured(cgs, style, false)),
                    HasSubstr("atom style '" + std::string(style) + "': must be sphere"));
    // Ours says it in the first line as well.
    EXPECT_EQ(read_spheres(text_file("s.data",
                                     "x, atom_style sphere, units si\n1 atoms\nAtoms\n\n"
                                     "1 1 0.5 2600 0 0 0\n"))
                  .spheres.size(),
              1u);
}

const char* const snapshots =
    "ITEM: UNITS\ncgs\nITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp ff pp\n"
    "0 4\n0 4\n0 4\nITEM: ATOMS id x y z radius\n1 1 1 1 0.5\n"
    "ITEM: TIMESTEP\n200\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp ff pp\n0 4\n0 8\n0 4\n"
    "ITEM: ATOMS type id x z y radius vx vy vz omegax omegay omegaz mass element\n"
    "1 9 1 2 3 0.5 0 0 0 0 0 0 1 C\n1 4 3 3 3 0.25 10 20 30 1 2 3 1 C\n";

TEST_F(LammpsDumpTest, TakesTheLastSnapshotByTheNamesOfItsColumns) {
    for (const char* name : {"s.dump", "s.lammpstrj", "s.txt", "s.data"}) {
        const SphereFile file = read_spheres(text_file(name, snapshots));
        ASSERT_EQ(file.spheres.size(), 2u);
        EXPECT_DOUBLE_EQ(file.spheres.radius[0], 0.0025) << "by atom id";
        EXPECT_EQ(file.spheres.position[1], Vec3(1e-2, 3 * 1e-2, 2 * 1e-2));
        EXPECT_EQ(file.spheres.velocity[0], Vec3(1e-2 * 10, 1e-2 * 20, 1e-2 * 30));
        EXPECT_EQ(file.spheres.spin[0], Vec3(1, 2, 3));
        EXPECT_EQ(file.spheres.mass[0], 1e-3);
        EXPECT_EQ(file.box->upper, Vec3(0.04, 0.08, 0.04));
        EXPECT_THAT(file.notes, testing::ElementsAre("the last of 2 snapshots, time step 200",
                                                     "units cgs: converted to SI"));
        EXPECT_EQ(file.lines, (std::vector<std::int32_t>{23, 22}));
    }
    const SphereFile scaled = read_spheres(
        text_file("s.dump",
                  "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp ff pp\n"
                  "1 3\n0 4\n0 8\nITEM: ATOMS xs ys zs diameter density\n0.5 0.5 0.5 0.5 1000\n"));
    EXPECT_EQ(scaled.spheres.position[0], Vec3(2, 2, 4));
    EXPECT_EQ(scaled.spheres.radius[0], 0.25);
    EXPECT_NEAR(scaled.spheres.mass[0], 1000 * 4.1887902047863909 / 64, 1e-12);
}

TEST_F(LammpsDumpTest, NamesWhatIsMissing) {
    const auto say = [&](const std::string& columns, const std::string& row) {
        return error("s.dump", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS " +
                                   columns + "\n" + row + "\n");
    };
    EXPECT_THAT(say("id x y z", "1 0 0 0"),
                StartsWith("s.dump:5: ITEM: ATOMS has no column radius; required: x y z (or"));
    EXPECT_THAT(say("id x y radius", "1 0 0 1"), HasSubstr("no column z"));
    EXPECT_THAT(say("id radius", "1 1"), HasSubstr("no column x"));
    EXPECT_THAT(say("x y z radius", "0 0 0"), HasSubstr("3 numbers, but ITEM: ATOMS names 4"));
    EXPECT_THAT(say("x y z radius", "0 0 0 -1"), HasSubstr("column radius = -1: must be > 0"));
    EXPECT_THAT(say("x y z radius", "0 0 0 1D-1"), HasSubstr("its exponent begins with D"));
    EXPECT_THAT(say("x y z radius mass", "0 0 0 0.5 1"), HasSubstr("median density is 1.91 kg/m3"));
    EXPECT_THAT(say("xs ys zs radius", "0 0 0 1"), HasSubstr("needs ITEM: BOX BOUNDS"));
    EXPECT_THAT(error("s.dump", ""), HasSubstr("ITEM: ATOMS is missing"));
    EXPECT_THAT(error("s.dump", "x\n"), HasSubstr("a line 'ITEM: ...' must stand here"));
    EXPECT_THAT(error("s.dump", "ITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS x\n1\n"),
                HasSubstr("ITEM: ATOMS ends too soon"));
    EXPECT_THAT(error("s.dump", "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1 0\n"),
                HasSubstr("tilted"));
    const SphereFile file = two_spheres();
    EXPECT_THAT(message_of<InputError>([&] { write_spheres(in_folder("s.dump"), file); }),
                HasSubstr(".dump is only read"));
}

TEST_F(YadeTextTest, TakesTheNumbersOfMaterials) {
    const SphereFile file = read_spheres(text_file(
        "s.txt", "# YADE export\n#format x_y_z_r_matId\n0.1 0.1 0.1 0.05 0\n0.3 0.1 0.1 0.04 2\n"));
    ASSERT_EQ(file.spheres.size(), 2u);
    EXPECT_EQ(file.spheres.radius[1], 0.04);
    ASSERT_EQ(file.notes.size(), 1u);
    EXPECT_THAT(file.notes[0], HasSubstr("2 materials (matId)"));
}

TEST_F(YadeTextTest, WritesOneLineASphereAndComesBack) {
    write_spheres(in_folder("s.txt"), two_spheres());
    EXPECT_EQ(read_whole_file(in_folder("s.txt")),
              "#format x_y_z_r\n0.25 0.5 -1 0.5\n1e-07 2 3 0.25\n");
    const SphereFile sample = make_sample(300);
    write_spheres(in_folder("s.txt"), sample);
    const SphereFile back = read_spheres(in_folder("s.txt"));
    EXPECT_TRUE(same_bits(back.spheres.position, sample.spheres.position));
    EXPECT_TRUE(same_bits(back.spheres.radius, sample.spheres.radius));
    EXPECT_FALSE(back.has_velocity || back.has_block || back.box);
}

TEST_F(YadeTextTest, TakesCommentsTabsAndBlankLines) {
    const SphereFile file =
        read_spheres(text_file("s.txt", "# x y z r\r\n\r\n1\t2 3  4 # first\r\n\n5 6 7 8"));
    ASSERT_EQ(file.spheres.size(), 2u);
    EXPECT_EQ(file.spheres.position[1], Vec3(5, 6, 7));
    EXPECT_EQ(file.lines, (std::vector<std::int32_t>{3, 5}));
}

TEST_F(YadeTextTest, NamesWhatIsWrong) {
    const auto say = [&](const std::string& text) { return error("s.txt", text); };
    EXPECT_EQ(say("0 0 0\n"), "s.txt:1: 3 numbers; must be four: x y z r");
    EXPECT_EQ(say("0 0 0 1 2 3\n"), "s.txt:1: more than four numbers; must be four: x y z r");
    EXPECT_EQ(say("\n0 0 0 -1\n"), "s.txt:2: column r = -1: must be > 0 m");
    EXPECT_EQ(say("0 inf 0 1\n"), "s.txt:1: column y = inf: must be a finite number [m]");
    EXPECT_EQ(say("#format x_y_z_r_attrs\n"),
              "s.txt:1: #format x_y_z_r_attrs: must be x_y_z_r or x_y_z_r_matId");
    EXPECT_EQ(say("# format x_y_z_r_matId\n0 0 0 1\n"),
              "s.txt:2: 4 numbers; must be five: x y z r matId");
    EXPECT_EQ(say("#format x_y_z_r_matId\n0 0 0 1 a\n"),
              "s.txt:2: column matId = a: must be an integer >= 0");
    EXPECT_THAT(say("0,0,0,1\n"), HasSubstr("; commas stand in it: columns must be separated by"));
    EXPECT_THAT(say("0;0;0;1\n"), HasSubstr("; semicolons stand in it"));
    EXPECT_THAT(say("0,1 0,1 0,1 0,05\n"), HasSubstr("column x = 0,1: must be a finite number [m]; "
                                                     "it has a decimal comma: must be a point"));
    EXPECT_THAT(say("0 0 0 1\r0 0 0 1\r"), HasSubstr("its lines end with CR alone (old Mac)"));
}

TEST_F(TextFormatsTest, NamesAnUnknownSuffix) {
    const SphereFile file = two_spheres();
    for (const char* name : {"s.vtk", "s", "s.CSV"}) {
        const auto path = in_folder(name);
        const std::string message = message_of<InputError>([&] { write_spheres(path, file); });
        EXPECT_THAT(message, HasSubstr("allowed: .h5, .csv, .data (LAMMPS), .txt (YADE)"));
        EXPECT_EQ(message_of<InputError>([&] { read_spheres(path); }), message);
    }
}

TEST_F(TextFormatsTest, RefusesColumnsOfDifferentLength) {
    SphereFile file = two_spheres();
    file.spheres.mass.pop_back();
    EXPECT_THROW(write_spheres(in_folder("s.csv"), file), std::invalid_argument);
}

}  // namespace
}  // namespace grainfield::core
