// The formats of other programs: LAMMPS data files and YADE's text.

#include <gmock/gmock.h>

#include "core/base/errors.hpp"
#include "core/files/text_file.hpp"
#include "tests/files/sample.hpp"

namespace grainfield::core {
namespace {

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
    const std::string head = "title\n\n2 atoms\n1 atom types\n\nAtoms\n\n1 1 1 2600 0 0 0\n";
    EXPECT_EQ(say(""), "s.data:1: the file is empty");
    EXPECT_THAT(say("title\n"), HasSubstr("'N atoms' is missing"));
    EXPECT_EQ(say("title\n2 atoms\n"), "s.data:2: section Atoms is missing");
    EXPECT_EQ(say("title\n-2 atoms\n"), "s.data:2: header atoms = -2: must be an integer >= 0");
    EXPECT_EQ(say("title\n1.5 atoms\n"), "s.data:2: header atoms = 1.5: must be an integer >= 0");
    EXPECT_EQ(say("title\n1 0 xlo xhi\n"), "s.data:2: xlo xhi: the second must be larger");
    EXPECT_THAT(say("title\n3 bonds\n"), HasSubstr("header '3 bonds': not supported; allowed: "));
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
              "s.data:4: atom style 'full': must be sphere");
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
    EXPECT_EQ(say("#format x_y_z_r_matId\n"), "s.txt:1: #format x_y_z_r_matId: must be x_y_z_r");
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
