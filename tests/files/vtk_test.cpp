// Does Debian's VTK, the one in Debian's ParaView 5.11, open what we write?

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>

#include "core/files/text_file.hpp"
#include "tests/files/sample.hpp"

namespace grainfield::core {
namespace {

class VtkTest : public FilesTest {
  protected:
    /// What VTK says about a sphere file; empty on failure.
    std::string ask_vtk(const SphereFile& sample) const {
        const auto file = in_folder("s.h5");
        const auto answer = in_folder("answer");
        write_spheres(file, sample);
        const std::string command =
            fmt::format("/usr/bin/python3 '{}/tests/files/read_vtkhdf.py' '{}' > '{}' 2>&1",
                        GRAINFIELD_SOURCE_DIR, file.string(), answer.string());
        const int status = std::system(command.c_str());
        const std::string text = read_whole_file(answer);
        EXPECT_EQ(status, 0) << text;
        return text;
    }

    void SetUp() override {
        if (std::system("/usr/bin/python3 -c 'from vtkmodules.vtkIOHDF import vtkHDFReader' "
                        ">/dev/null 2>&1") != 0)
            GTEST_SKIP() << "/usr/bin/python3 cannot import vtkmodules (package python3-vtk9)";
    }
};

/// Python's float.hex(), which prints all digits.
std::string hex(double value) {
    return fmt::format("{}{:.13a}", value < 0 ? "-" : "", std::abs(value));
}

TEST_F(VtkTest, OpensASphereFile) {
    for (std::size_t n : {1, 351, 40000}) {
        const SphereFile sample = make_sample(n);
        const ParticleStore& s = sample.spheres;
        const std::string expected = fmt::format(
            "class vtkUnstructuredGrid\npoints {0} double\ncells {0}\nvertices {0}\n"
            "array block {0} 3 int\narray friction_angle {0} 1 double\narray mass {0} 1 double\n"
            "array normal_stiffness {0} 1 double\narray radius {0} 1 double\n"
            "array spin {0} 3 double\narray velocity {0} 3 double\n"
            "last {1} {2} {3} {4}\nblock {5} {6} {7}\n",
            n, hex(s.position.x[n - 1]), hex(s.position.y[n - 1]), hex(s.position.z[n - 1]),
            hex(s.radius[n - 1]), s.block[n - 1][0], s.block[n - 1][1], s.block[n - 1][2]);
        EXPECT_EQ(ask_vtk(sample), expected);
    }
}

}  // namespace
}  // namespace grainfield::core
