// AVX2 and AVX-512 give the same bits: the nodes of a cluster need not be alike.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "core/files/sphere_file.hpp"
#include "kernels/instruction_set.hpp"
#include "tests/program/program.hpp"
#include "tests/triaxial/small_test.hpp"

namespace grainfield::program_tests {
namespace {

class InstructionSets : public ::testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        for (const auto isa : {kernels::InstructionSet::avx2, kernels::InstructionSet::avx512})
            if (!kernels::runs_here(isa)) GTEST_SKIP() << "this machine lacks one of them";
        const triaxial::Sample sample = triaxial::testing::dense_sample(200);
        core::SphereFile file;
        file.spheres = sample.spheres;
        file.box = sample.box;
        core::write_spheres(place_.path("P.h5"), file);
        const Vec3 size = sample.box.size();
        place_.write("c.toml", fmt::format("[packing]\nblocks = [2, 4, 2]\nblock = [{}, {}, {}]\n"
                                           "[field]\nvariable = 'stiffness'\nstiffness.cov = 1.0\n"
                                           "[triaxial]\nmax_axial_strain = 0.02\n"
                                           "[montecarlo]\nrealizations = 3\n",
                                           size.x() / 2, size.y() / 4, size.z() / 2));
    }
    std::string run(const std::string& command, const std::string& isa, std::string folder = "",
                    const std::vector<std::string>& more = {}) {
        if (folder.empty()) folder = isa;
        std::vector<std::string> words{command,     place_.path("c.toml"),
                                       "--packing", place_.path("P.h5"),
                                       "--out",     place_.path(folder),
                                       "--isa",     isa,
                                       "--set",     "solver.precision=" + GetParam()};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = place_.run(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return folder;
    }
    Workplace place_;
};

TEST_P(InstructionSets, OneStateOfATest) {
    const std::string a = run("triaxial", "avx2", "a", {"--realization", "2"}),
                      b = run("triaxial", "avx512", "b", {"--realization", "2"});
    EXPECT_EQ(place_.json(a + "/summary.json").at("state_hash"),
              place_.json(b + "/summary.json").at("state_hash"));
    for (const char* file : {"/curve.csv", "/energy.csv"})
        EXPECT_EQ(place_.read(a + file), place_.read(b + file)) << file;
}

/// A table without its column of wall times.
std::string timeless(const std::string& table) {
    std::istringstream lines(table);
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream fields(line);
        std::size_t k = 0;
        for (std::string field; std::getline(fields, field, ','); ++k)
            if (k != 9) text += field + ',';
        text += '\n';
    }
    return text;
}

TEST_P(InstructionSets, OneTableOfACampaign) {
    const std::string a = run("montecarlo", "avx2");
    // The shards of one folder, each on a machine of its own.
    const std::string b = run("montecarlo", "avx512", "both", {"--shard", "1/2"});
    run("montecarlo", "avx2", "both", {"--shard", "2/2"});
    for (const char* file : {"/results.csv", "/deterministic.csv"}) {
        const std::string table = timeless(place_.read(a + file));
        EXPECT_NE(table.find(",done,"), std::string::npos) << table;
        EXPECT_EQ(table, timeless(place_.read(b + file))) << file;
    }
}

INSTANTIATE_TEST_SUITE_P(Precision, InstructionSets, ::testing::Values("mixed", "double"),
                         [](const auto& test_info) { return test_info.param; });

}  // namespace
}  // namespace grainfield::program_tests
