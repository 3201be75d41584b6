// `dev` and `.ci/run` as a bare machine meets them. The tools they call are stand-ins that write
// down how they were called; nothing is installed or built.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace grainfield::repository {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string read(const fs::path& path) {
    std::ifstream stream(path);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class DevScript : public testing::Test {
  protected:
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
        tool("cmake", record);
        tool("ctest", record);
        tool("apt-get", record);
        tool("dpkg-query", "echo installed");
        tool("id", "echo 0");
        tool("sudo", record);
    }
    void TearDown() override { fs::remove_all(folder); }

    /// Puts a stand-in for a tool first in the path.
    void tool(const std::string& name, const std::string& body) const {
        const fs::path path = folder / name;
        std::ofstream(path) << "#!/bin/sh\n" << body << "\n";
        fs::permissions(path, fs::perms::owner_all);
    }

    /// Runs a script of the repository from a foreign folder, without stdin; gives its exit code.
    int run(const std::string& script, const std::string& arguments) const {
        const std::string command = "cd / && PATH='" + folder.string() + "':\"$PATH\" CALLS='" +
                                    (folder / "calls").string() + "' '" GRAINFIELD_SOURCE_DIR "/" +
                                    script + "' " + arguments + " <&- >'" +
                                    (folder / "output").string() + "' 2>&1";
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }

    std::string calls() const { return read(folder / "calls"); }
    std::string output() const { return read(folder / "output"); }

    const std::string record = "echo \"$(basename \"$0\") $*\" >>\"$CALLS\"";
    const fs::path folder =
        fs::temp_directory_path() / ("grainfield_dev_" + std::to_string(::getpid()));
};

TEST_F(DevScript, HelpNamesEveryCommand) {
    EXPECT_EQ(run("dev", "help"), 0);
    for (const char* command :
         {"run", "test", "verify", "build", "bench", "crosscheck", "reliability", "format", "lint"})
        EXPECT_THAT(output(), HasSubstr("\n  " + std::string(command) + " "));
}

TEST_F(DevScript, RefusesAnUnknownCommand) {
    EXPECT_EQ(run("dev", "biuld"), 2);
    EXPECT_THAT(output(), HasSubstr("unknown command 'biuld'"));
    EXPECT_THAT(calls(), IsEmpty());
}

TEST_F(DevScript, InstallsNothingWhereAllIsThere) {
    EXPECT_EQ(run("dev", "build"), 0) << output();
    EXPECT_EQ(calls(), "cmake --preset release\ncmake --build --preset release -j\n");
}

TEST_F(DevScript, InstallsExactlyWhatIsMissing) {
    tool("dpkg-query", "case $* in *gnuplot-nox | *g++) exit 1 ;; *) echo installed ;; esac");
    EXPECT_EQ(run("dev", "build"), 0) << output();
    EXPECT_THAT(calls(), HasSubstr(" update\n"));
    EXPECT_THAT(calls(), HasSubstr("install -y --no-install-recommends g++ gnuplot-nox\n"));
    EXPECT_THAT(calls(), Not(HasSubstr("sudo")));
}

TEST_F(DevScript, InstallsTheTestsPackagesOnlyForTests) {
    tool("dpkg-query", "case $* in *chromium) exit 1 ;; *) echo installed ;; esac");
    EXPECT_EQ(run("dev", "build"), 0) << output();
    EXPECT_THAT(calls(), Not(HasSubstr("apt-get")));
    EXPECT_EQ(run("dev", "test --quick"), 0) << output();
    EXPECT_THAT(calls(), HasSubstr("--no-install-recommends chromium\n"));
}

TEST_F(DevScript, InstallsThePeersOnlyForTheCrossCheckAndGoesOnWithoutThem) {
    tool("dpkg-query", "case $* in *yade) exit 1 ;; *) echo installed ;; esac");
    EXPECT_EQ(run("dev", "test"), 0) << output();
    EXPECT_THAT(calls(), Not(HasSubstr("apt-get")));
    tool("apt-get", record + "; exit 100");
    tool("cmake", "exit 3");  // what follows would take minutes
    EXPECT_EQ(run("dev", "crosscheck"), 3);
    EXPECT_THAT(calls(), HasSubstr("install -y --no-install-recommends yade\n"));
    EXPECT_THAT(output(), HasSubstr("going on with the peers that are there"));
}

TEST_F(DevScript, InstallsWhatReliabilityNeedsForThatOnlyAndKnowsItsParts) {
    tool("dpkg-query", "case $* in *valgrind) exit 1 ;; *) echo installed ;; esac");
    EXPECT_EQ(run("dev", "test"), 0) << output();
    EXPECT_THAT(calls(), Not(HasSubstr("apt-get")));
    EXPECT_EQ(run("dev", "reliability nonsense"), 1);
    EXPECT_THAT(calls(), HasSubstr("install -y --no-install-recommends valgrind\n"));
    EXPECT_THAT(output(), HasSubstr("no part 'nonsense' in tests/reliability"));
}

TEST_F(DevScript, UsesSudoWhereNotRootAndNeverAsks) {
    tool("dpkg-query", "case $* in *g++) exit 1 ;; *) echo installed ;; esac");
    tool("id", "echo 1000");
    EXPECT_EQ(run("dev", "build"), 0) << output();
    EXPECT_THAT(calls(), HasSubstr("sudo -n env DEBIAN_FRONTEND=noninteractive apt-get"));
}

TEST_F(DevScript, SaysWhatToInstallWhereItCannot) {
    tool("dpkg-query", "case $* in *g++) exit 1 ;; *) echo installed ;; esac");
    tool("id", "echo 1000");
    tool("sudo", "exit 1");
    EXPECT_EQ(run("dev", "build"), 1);
    EXPECT_THAT(output(), HasSubstr("as root: apt-get install g++"));
    EXPECT_THAT(calls(), IsEmpty());

    tool("id", "echo 0");
    tool("apt-get", "exit 100");
    EXPECT_EQ(run("dev", "build"), 1);
    EXPECT_THAT(output(), HasSubstr("could not install g++"));
    EXPECT_THAT(calls(), IsEmpty());
}

TEST_F(DevScript, StopsWhereConfiguringFails) {
    tool("cmake", record + "; exit 3");
    EXPECT_EQ(run("dev", "build"), 3);
    EXPECT_EQ(calls(), "cmake --preset release\n");
}

TEST_F(DevScript, CiRunsUnitsThenSanitizersThenTheLongTests) {
    tool("ctest", record + "; echo \"kernels: $GRAINFIELD_TEST_KERNELS.\" >>\"$CALLS\"");
    EXPECT_EQ(run(".ci/run", ""), 0) << output();
    EXPECT_EQ(calls(),
              "cmake --preset release\ncmake --build --preset release --target all_tests -j\n"
              "cmake -E rm -rf build/release/test_times\n"
              "ctest --preset release -L ^unit$ -j 2 --no-tests=error\nkernels: .\n"
              "cmake --preset asan\ncmake --build --preset asan --target sanitized_tests -j\n"
              "ctest --preset asan -L ^sanitized$ -j 2 --no-tests=error\nkernels: sanitizers.\n"
              "ctest --preset release -L ^long$ -j 2 --no-tests=error\nkernels: .\n");
}

TEST_F(DevScript, QuickTestsAreTheUnitsAlone) {
    EXPECT_EQ(run("dev", "test --quick"), 0) << output();
    EXPECT_THAT(calls(), HasSubstr("ctest --preset release -L ^unit$ -j 2"));
    EXPECT_THAT(calls(), Not(HasSubstr("asan")));
    EXPECT_THAT(calls(), Not(HasSubstr("long")));
}

TEST_F(DevScript, AllTestsRunOnEveryKernel) {
    tool("ctest", record + "; echo \"kernels: $GRAINFIELD_TEST_KERNELS.\" >>\"$CALLS\"");
    EXPECT_EQ(run("dev", "test --all"), 0) << output();
    EXPECT_THAT(calls(), HasSubstr("-L ^unit$ -j 2 --no-tests=error\nkernels: all.\n"));
    EXPECT_THAT(calls(), HasSubstr("-L ^sanitized$ -j 2 --no-tests=error\nkernels: sanitizers.\n"));
    EXPECT_THAT(calls(), HasSubstr("-L ^(long|extra)$ -j 2 --no-tests=error\nkernels: all.\n"));
}

TEST_F(DevScript, TestsCanBeChosen) {
    EXPECT_EQ(run("dev", "test core"), 0) << output();
    EXPECT_EQ(calls(),
              "cmake --preset release\ncmake --build --preset release --target test_core -j\n"
              "ctest --preset release -R ^core(\\.[0-9]+)?$ -j 2 --no-tests=error\n");
    // A filter: the programs that are there are asked themselves.
    fs::remove(folder / "calls");
    EXPECT_EQ(run("dev", "test 'No such suite.*'"), 0) << output();
    EXPECT_EQ(calls(),
              "cmake --preset release\ncmake --build --preset release --target all_tests -j\n");
    if (fs::exists(GRAINFIELD_SOURCE_DIR "/build/release/tests/test_repository")) {
        EXPECT_THAT(output(), HasSubstr("0 tests from 0 test suites ran"));
    }
    EXPECT_EQ(run("dev", "test --qick"), 1);
    EXPECT_THAT(output(), HasSubstr("no option '--qick'"));
}

TEST_F(DevScript, VerifyWritesThePageFromATestRunOnly) {
    const std::string first =
        "cmake --preset release\ncmake --build --preset release --target all_tests -j\n"
        "cmake -E rm -rf build/release/verification\n"
        "ctest --preset release -L ^verify$ -j 2 --no-tests=error\n";
    tool("ctest", record + "; exit 8");
    EXPECT_EQ(run("dev", "verify"), 8) << output();
    EXPECT_EQ(calls(), first);

    fs::remove(folder / "calls");
    tool("ctest", record + "; echo \"in $GRAINFIELD_VERIFICATION\"");
    EXPECT_EQ(run("dev", "verify"), 0) << output();
    EXPECT_EQ(calls(), first +
                           "cmake --preset release\n"
                           "cmake --build --preset release --target verification_page -j\n");
    EXPECT_THAT(output(), HasSubstr("in " GRAINFIELD_SOURCE_DIR "/build/release/verification\n"));
}

TEST_F(DevScript, FailsWithAnyTestAndStillRunsTheOthers) {
    tool("ctest", record + "; case $* in *asan*) exit 8 ;; esac");
    EXPECT_EQ(run("dev", "test"), 1);
    EXPECT_THAT(output(), HasSubstr("failed: sanitizers"));
    EXPECT_THAT(calls(), HasSubstr("-L ^long$"));
}

}  // namespace
}  // namespace grainfield::repository
