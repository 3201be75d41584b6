// Files and keys of other programs: read where what is needed is there, else refused with what is
// missing.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include "core/files/hdf5_writer.hpp"
#include "tests/cases/sample.hpp"

namespace grainfield::case_tests {
namespace {

using program_tests::Outcome;
using program_tests::Workplace;

class ForeignFormat : public testing::Test {
  protected:
    void expect_read(const std::string& name, const std::string& text) {
        const Outcome outcome = convert(name, text);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        const core::ParticleStore s = core::read_spheres(place_.path("out.csv")).spheres;
        ASSERT_EQ(s.size(), 2u);
        EXPECT_NEAR(s.position.x[1], 0.3, 1e-12);
        EXPECT_NEAR(s.position.z[1], 0.1, 1e-12);
        EXPECT_NEAR(s.radius[1], 0.05, 1e-12);
    }
    void expect_refused(const std::string& name, const std::string& text, const std::string& part) {
        const Outcome outcome = convert(name, text);
        EXPECT_TRUE(outcome.code == 2 || outcome.code == 4) << outcome.code;
        EXPECT_TRUE(has(outcome.err, part)) << outcome.err;
        EXPECT_EQ(place_.run({"info", place_.path(name)}).code, outcome.code);
    }
    Outcome convert(const std::string& name, const std::string& text) {
        return place_.run({"convert", place_.write(name, text), place_.path("out.csv")});
    }

    Workplace place_;
};

/// Two spheres whose rows have these columns: {id}, {x}, {q} of each.
std::string atoms(const std::string& style, const std::string& row) {
    std::string text =
        "LAMMPS data file, units = si\n\n2 atoms\n1 atom types\n\nAtoms # " + style + "\n\n";
    for (const auto& [id, x] : {std::pair{1, 0.1}, std::pair{2, 0.3}})
        text += fmt::format(fmt::runtime(row), fmt::arg("id", id), fmt::arg("x", x)) + "\n";
    return text;
}

TEST_F(ForeignFormat, AtomStylesWithADiameterAreRead) {
    const std::string sphere = "{id} 1 0.1 2600 {x} 0.1 0.1";
    expect_read("P.data", atoms("sphere", sphere));
    expect_read("P.data", atoms("granular", sphere));
    expect_read("P.data", atoms("granular", sphere + " 0 0 -1"));
    expect_read("P.data", atoms("bpm/sphere", "{id} 7 1 0.1 2600 {x} 0.1 0.1"));
    const std::string hybrid = "{id} 1 {x} 0.1 0.1";
    expect_read("P.data", atoms("hybrid sphere", hybrid + " 0.1 2600"));
    expect_read("P.data", atoms("hybrid granular", hybrid + " 0.1 2600"));
    expect_read("P.data", atoms("hybrid atomic sphere", hybrid + " 0.1 2600"));
    expect_read("P.data", atoms("hybrid sphere charge", hybrid + " 0.1 2600 -3"));
    expect_read("P.data", atoms("hybrid charge sphere", hybrid + " -3 0.1 2600"));
    expect_read("P.data", atoms("hybrid molecular sphere", hybrid + " 4 0.1 2600"));
    expect_read("P.data", atoms("hybrid full sphere", hybrid + " 4 -3 0.1 2600"));
}

TEST_F(ForeignFormat, OtherAtomStylesAreRefusedWithWhatTheyLack) {
    for (const char* style : {"full", "atomic", "molecular", "ellipsoid", "line", "body", "peri"})
        expect_refused("P.data", atoms(style, "{id} 1 0.1 2600 {x} 0.1 0.1"),
                       fmt::format("atom style '{}': must be sphere, granular, bpm/sphere or a "
                                   "hybrid with sphere, which have a diameter and a density",
                                   style));
    expect_refused("P.data", atoms("hybrid sphere charge", "{id} 1 {x} 0.1 0.1 0.1 2600"),
                   "must be: atom-ID atom-type x y z diameter density q");
    std::string silent = atoms("sphere", "{id} 1 0.1 2600 {x} 0.1 0.1");
    silent.erase(silent.find(" # sphere"), 9);
    expect_refused("P.data", silent, "the atom style is not said");
}

// The packing itself, with the columns of sphere under the name of a hybrid: spheres would overlap.
TEST_F(ForeignFormat, ColumnsInAnotherOrderThanTheStylesAreRefused) {
    std::string text = lammps_text({});
    text.replace(text.find("# sphere"), 8, "# hybrid sphere");
    expect_refused("P.data", text, "the columns of this atom style are: atom-ID atom-type x y z");
    const Outcome right = convert("P.data", lammps_text({.style = "hybrid sphere"}));
    EXPECT_EQ(right.code, 0) << right.err;
}

TEST_F(ForeignFormat, DumpFilesAreReadByTheNamesOfTheirColumns) {
    const auto dump = [](const std::string& columns, const std::string& row) {
        std::string text =
            "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 "
            "1\nITEM: ATOMS " +
            columns + "\n";
        for (const auto& [id, x] : {std::pair{1, 0.1}, std::pair{2, 0.3}})
            text += fmt::format(fmt::runtime(row), fmt::arg("id", id), fmt::arg("x", x)) + "\n";
        return text;
    };
    for (const char* name : {"P.dump", "P.lammpstrj", "P.txt", "P.data"}) {
        expect_read(name, dump("id type x y z diameter", "{id} 1 {x} 0.1 0.1 0.1"));
        expect_read(name, dump("radius zu yu xu id", "0.05 0.1 0.1 {x} {id}"));
        expect_read(name, dump("id xs ys zs radius", "{id} {x} 0.1 0.1 0.05"));
        expect_refused(name, dump("id x y z", "{id} {x} 0.1 0.1"), "has no column radius");
        expect_refused(name, dump("id x y z c_radius", "{id} {x} 0.1 0.1 0.05"),
                       "no column radius");
    }
    expect_refused("P.dump", "ITEM: UNITS\nlj\n" + dump("id x y z radius", "{id} {x} 0 0 0.05"),
                   "units lj: without dimensions");
}

TEST_F(ForeignFormat, YadesMaterialsNeedTheirFormatLine) {
    const std::string rows = "0.1 0.1 0.1 0.05 0\n0.3 0.1 0.1 0.05 1\n";
    expect_read("P.txt", "# export.textExt\n#format x_y_z_r_matId\n" + rows);
    expect_refused("P.txt", rows, "or five under a line '#format x_y_z_r_matId'");
    expect_refused("P.txt", "#format x_y_z_r_attrs\n" + rows, "must be x_y_z_r or x_y_z_r_matId");
    expect_refused("P.txt", "#format x_y_z_r_clumpId\n" + rows, "must be x_y_z_r or");
}

/// A VTKHDF file as ParaView writes it, with these data of its points.
std::string vtkhdf(const std::string& name, double value) {
    core::Hdf5Writer writer;
    writer.group("/VTKHDF");
    constexpr std::array<std::int64_t, 2> version{2, 0};
    writer.attribute("/VTKHDF", "Version", version);
    writer.attribute("/VTKHDF", "Type", "PolyData");
    const std::vector<double> points{0.1, 0.1, 0.1, 0.3, 0.1, 0.1}, values{value, value};
    writer.dataset<double>("/VTKHDF/Points", {2, 3}, points);
    writer.group("/VTKHDF/PointData");
    writer.dataset<double>("/VTKHDF/PointData/" + name, {2}, values);
    return writer.finish();
}

TEST_F(ForeignFormat, VtkHdfIsReadWhereItHasASize) {
    for (const char* name : {"P.h5", "P.vtkhdf"}) {
        expect_read(name, vtkhdf("radius", 0.05));
        expect_read(name, vtkhdf("diameter", 0.1));
        expect_refused(name, vtkhdf("pressure", 3), "/VTKHDF/PointData/radius is missing");
    }
    place_.write("P.h5", vtkhdf("radius", 0.05));
    // Only read: what is written has the usual name.
    const Outcome written = place_.run({"convert", place_.path("P.h5"), place_.path("Q.vtkhdf")});
    EXPECT_EQ(written.code, 2) << written.err;
}

TEST_F(ForeignFormat, OtherSuffixesAreRefusedWithThoseThatAreRead) {
    for (const char* name : {"P.xyz", "P.vtk", "P.vtu", "P.stl", "P.CSV", "P"})
        expect_refused(name, "0.1 0.1 0.1 0.05\n", ".h5, .csv, .data (LAMMPS), .txt (YADE)");
}

TEST_F(ForeignFormat, FeaturesOfOtherRandomFieldsAreRefusedWithWhatThereIs) {
    for (const auto& [setting, part] :
         {std::pair{"field.nugget=0.1", "has no nugget: errors of measured values are the column"},
          std::pair{"field.nugget_effect=0.1", "has no nugget"},
          std::pair{"field.angles=[30,0,0]", "the axes of correlation are x, y and z"},
          std::pair{"field.rotation=30", "the axes of correlation are x, y and z"},
          std::pair{"field.correlation_length=[inf,1,inf]", "numbers > 0 is expected, which inf"},
          std::pair{"field.correlation_length=[1,1]", "an array of 3 numbers > 0"},
          std::pair{"field.correlation=\"exponential\"", "one of \"markov\""},
          std::pair{"field.stiffness.cov=80%", "not valid TOML"}}) {
        const Outcome outcome =
            place_.run({"field", "--set", setting, "--out", place_.path("f.csv")});
        EXPECT_EQ(outcome.code, 2) << setting;
        EXPECT_TRUE(has(outcome.err, part)) << outcome.err;
    }
    // A layer that goes on for ever is one of a length beyond all others.
    const Outcome layer =
        place_.run({"field", "--set", "field.correlation_length=[1e9,1,1e9]", "--set",
                    "field.variable=\"stiffness\"", "--out", place_.path("f.csv")});
    EXPECT_EQ(layer.code, 0) << layer.err;
}

}  // namespace
}  // namespace grainfield::case_tests
