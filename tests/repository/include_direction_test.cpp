// The folders are the architecture: kernels <- core <- packing, randomfield, triaxial <- bench,
// tests. No file may include against it, and the checker is shown to find every kind of fault.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "tests/repository/include_rules.hpp"
#include "tests/repository/source_tree.hpp"

namespace grainfield::repository {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> faults_in(const std::string& path, const std::string& text) {
    return faults_of({path, text});
}

TEST(IncludeDirection, NoSourceBreaksIt) {
    std::set<std::string> folders;
    for (const SourceFile& file : text_files(GRAINFIELD_SOURCE_DIR)) {
        if (is_cpp(file.path)) folders.insert(first_folder(file.path));
        EXPECT_THAT(faults_of(file), IsEmpty());
    }
    for (const char* folder : {"kernels", "core", "packing", "randomfield", "triaxial", "tests"})
        EXPECT_THAT(folders, Contains(folder)) << "the walk missed a module";
}

TEST(IncludeChecker, KnowsEveryPairOfModules) {
    const std::vector<std::string> names = {"kernels",  "core",  "packing", "randomfield",
                                            "triaxial", "bench", "tests"};
    const std::vector<std::string> allowed = {"1000000", "1100000", "1110000", "1101000",
                                              "1111100", "1111110", "1111111"};
    for (std::size_t from = 0; from < names.size(); ++from)
        for (std::size_t to = 0; to < names.size(); ++to)
            for (const char* file : {"/a.cpp", "/a.hpp", "/deeper/a.h"}) {
                const std::string line = "#include \"" + names[to] + "/x.hpp\"";
                EXPECT_EQ(faults_in(names[from] + file, line).empty(), allowed[from][to] == '1')
                    << names[from] << " -> " << names[to];
            }
}

TEST(IncludeChecker, NamesFileLineAndRule) {
    EXPECT_THAT(faults_in("kernels/a.hpp", "#pragma once\n#include \"core/b.hpp\"\n"),
                ElementsAre("kernels/a.hpp:2: #include \"core/b.hpp\": is against the include "
                            "direction: kernels may include kernels only"));
}

TEST(IncludeChecker, WantsOwnHeadersQuotedFromTheRoot) {
    const char* const rooted = "from the root";
    EXPECT_THAT(faults_in("core/a.cpp", "#include \"a.hpp\""), ElementsAre(HasSubstr(rooted)));
    EXPECT_THAT(faults_in("core/a.cpp", "#include \"./a.hpp\""), ElementsAre(HasSubstr(rooted)));
    EXPECT_THAT(faults_in("core/a.cpp", "#include \"core/../triaxial/a.hpp\""),
                ElementsAre(HasSubstr(rooted)));
    EXPECT_THAT(faults_in("core/a.cpp", "#include \"fmt/format.h\""),
                ElementsAre(HasSubstr(rooted)));
    EXPECT_THAT(faults_in("core/a.cpp", "#include <core/a.hpp>"), ElementsAre(HasSubstr("quotes")));
    EXPECT_THAT(faults_in("core/a.cpp", "#include HEADER"), ElementsAre(HasSubstr("hides")));
}

TEST(IncludeChecker, ReadsEverySpelling) {
    for (const char* line :
         {"  #  include   \"triaxial/x.hpp\"", "#include\"triaxial/x.hpp\"",
          "#include \"triaxial/x.hpp\"  // why", "#include \"triaxial/x.hpp\" /* why */",
          "/* why */ #include \"triaxial/x.hpp\"", "#include \"triaxial/x.hpp\"\r",
          "#import \"triaxial/x.hpp\""})
        EXPECT_THAT(faults_in("core/a.cpp", line), ElementsAre(HasSubstr("direction"))) << line;
}

TEST(IncludeChecker, KeepsConsoleAndConfigOutOfKernelsAndCore) {
    for (const char* header :
         {"iostream", "print", "spdlog/spdlog.h", "toml++/toml.h", "CLI/CLI.hpp"}) {
        const std::string line = "#include <" + std::string(header) + ">";
        EXPECT_THAT(faults_in("core/a.cpp", line), ElementsAre(HasSubstr("console"))) << header;
        EXPECT_THAT(faults_in("kernels/a.hpp", line), ElementsAre(HasSubstr("console")));
        EXPECT_THAT(faults_in("triaxial/cli/a.cpp", line), IsEmpty());
    }
    for (const char* line : {"std::cout << x;", "std::printf(\"x\");", "std::fprintf(stderr, s);",
                             "puts(s);", "fmt::print(\"x\");"}) {
        EXPECT_THAT(faults_in("core/a.cpp", line), ElementsAre(HasSubstr("console"))) << line;
        EXPECT_THAT(faults_in("triaxial/cli/a.cpp", line), IsEmpty());
    }
}

TEST(IncludeChecker, KeepsAllocationOutOfKernels) {
    for (const char* line :
         {"#include <vector>", "#include <unordered_map>", "auto* p = new T;", "std::malloc(n);"}) {
        EXPECT_THAT(faults_in("kernels/a.hpp", line), ElementsAre(HasSubstr("allocates"))) << line;
        EXPECT_THAT(faults_in("core/a.hpp", line), IsEmpty()) << line;
    }
}

TEST(IncludeChecker, LetsHonestLinesPass) {
    for (const char* line :
         {"#include <span>", "#include <Eigen/Core>", "#include \"kernels/vec3.hpp\"",
          "// a new overlap; printf would be wrong, as would #include <vector>",
          "throw Error(\"stdout is full, new try\");", "int renew = 1'000; char c = '\"';",
          "std::snprintf(s, n, f);", "/* #include \"core/x.hpp\"", "f(R\"(\" new malloc)\");"})
        EXPECT_THAT(faults_in("kernels/a.hpp", line), IsEmpty()) << line;
    EXPECT_THAT(faults_in("README.md", "#include \"core/x.hpp\""), IsEmpty());
}

TEST(CodeOnly, BlanksCommentsAndLiteralsAndKeepsTheRest) {
    EXPECT_EQ(code_only("a // b\nc"), "a     \nc");
    EXPECT_EQ(code_only("a /* b\n c */ d"), "a     \n      d");
    EXPECT_EQ(code_only("f(\"x\\\"y\", 'z');"), "f(\"    \", ' ');");
    EXPECT_EQ(code_only("1'000 + 'c' + 2'0"), "1'000 + ' ' + 2'0");
    EXPECT_EQ(code_only("R\"--(a\n\")--\" b"), "R\"    \n )--\" b");
    EXPECT_EQ(code_only("open /* to the end"), "open              ");
    EXPECT_EQ(code_only("open \"to the end"), "open \"          ");
}

}  // namespace
}  // namespace grainfield::repository
