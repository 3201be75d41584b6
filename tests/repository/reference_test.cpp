// Comments and documents lead somewhere: the files, lines and folders that they name exist. The
// checker is shown to find every kind of fault.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/repository/reference_rules.hpp"
#include "tests/repository/source_tree.hpp"

namespace grainfield::repository {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(References, LeadToFilesAndLinesThatExist) {
    std::map<std::string, std::string> all;
    for (const std::string& path : file_paths(GRAINFIELD_SOURCE_DIR)) all[path];
    const std::vector<SourceFile> texts = text_files(GRAINFIELD_SOURCE_DIR);
    for (const SourceFile& file : texts) all[file.path] = file.text;
    const ReferenceTargets targets(all);
    std::size_t refer = 0;
    for (const SourceFile& file : texts) {
        refer += referring_text(file).empty() ? 0 : 1;
        EXPECT_THAT(reference_faults(file, targets), IsEmpty());
    }
    EXPECT_GT(refer, 100U) << "the walk found next to nothing";
}

/// Faults of a made-up file in a made-up repository.
std::vector<std::string> made_faults(const std::string& path, const std::string& text) {
    static const ReferenceTargets targets({{"core/a.hpp", "one\nvoid step(double h);\n"},
                                           {"core/drive/servo.hpp", ""},
                                           {"core/drive/servo.cpp", ""},
                                           {"core/twice.hpp", ""},
                                           {"bench/twice.hpp", ""},
                                           {"docs/method.md", "x\n"},
                                           {"docs/picture.png", ""},
                                           {"README.md", ""}});
    return reference_faults({path, text}, targets);
}

TEST(ReferenceChecker, FindsFilesThatAreNotThere) {
    EXPECT_THAT(made_faults("core/a.hpp", "int x;\n// as in gone.hpp says\n"),
                ElementsAre("core/a.hpp:2: gone.hpp: no such file"));
    for (const char* comment :
         {"// core/gone.cpp", "/* (core/gone.cpp) */", "int x;  ///< see `core/gone.cpp`.",
          "// wrong folder: bench/a.hpp", "// physics.md, \"Loading rate\"",
          "// gone.toml:", "// core/drive/gone_*.cpp", "// lists in gone.inc and data in gone.csv"})
        EXPECT_THAT(made_faults("core/b.cpp", comment), Not(IsEmpty())) << comment;
    EXPECT_THAT(made_faults("core/b.cpp", "// gone.inc and gone.csv").size(), 2U);
    EXPECT_THAT(made_faults("core/b.cpp", "// twice.hpp"), IsEmpty()) << "in its own folder";
    EXPECT_THAT(made_faults("docs/b.md", "twice.hpp"), ElementsAre(HasSubstr("2 files end so")));
}

TEST(ReferenceChecker, ReadsDocumentsAndScripts) {
    EXPECT_THAT(made_faults("docs/b.md", "See `gone.md`."), ElementsAre(HasSubstr("docs/b.md:1")));
    EXPECT_THAT(made_faults("dev", "#!/bin/sh\nx=1  # into gone.md\n"),
                ElementsAre(HasSubstr("dev:2")));
    EXPECT_THAT(made_faults("a.py", "\"\"\"As\ngone.py does.\"\"\"\nopen('made.csv')\n"),
                ElementsAre(HasSubstr("a.py:2")));
    EXPECT_THAT(made_faults("bench/c.toml", "file = \"x.csv\"  # gone.csv"),
                ElementsAre(HasSubstr("gone.csv")));
}

TEST(ReferenceChecker, LetsHonestNamesPass) {
    for (const char* text :
         {"// core/a.hpp", "// a.hpp, and servo.cpp.", "// drive/servo.hpp", "// docs/method.md",
          "// ../core/a.hpp", "// ./docs/method.md", "// core/drive/servo*.cpp", "// .h5 or .csv",
          "// summary.json and run/P.h5 and cases/NAME.toml", "// x.size() and s.mass.data()",
          "// https://example.org/gone.html", "open(\"gone.csv\");", "#include \"gone.hpp\"",
          "// config.html() and result.json.value"})
        EXPECT_THAT(made_faults("bench/b.cpp", text), IsEmpty()) << text;
    EXPECT_THAT(made_faults("README.md", "```sh\ncat gone.csv\n```\n"), IsEmpty());
    EXPECT_THAT(made_faults("data.csv", "gone.hpp"), IsEmpty());
}

TEST(ReferenceChecker, FollowsLinks) {
    for (const char* sound :
         {"[a](method.md)", "[b](../README.md)", "[c](../core/)", "[c](../core/drive)",
          "![p](picture.png)", "[u](https://example.org)", "[h](#head)", "[h](method.md#head)"})
        EXPECT_THAT(made_faults("docs/b.md", sound), IsEmpty()) << sound;
    EXPECT_THAT(made_faults("docs/b.md", "[a](gone.md)"), ElementsAre(HasSubstr("no such file")));
    EXPECT_THAT(made_faults("docs/b.md", "![a](gone.png)"), ElementsAre(HasSubstr("gone.png")));
    EXPECT_THAT(made_faults("docs/b.md", "[a](README.md)"), ElementsAre(HasSubstr("README.md")))
        << "links count from their own folder";
}

TEST(ReferenceChecker, LooksAtTheLineThatALinkPointsTo) {
    for (const char* sound : {"[`Simulation::step`](../core/a.hpp#L2)", "[step](../core/a.hpp#L2)",
                              "[`step()`](../core/a.hpp#L2-L2)"})
        EXPECT_THAT(made_faults("docs/b.md", sound), IsEmpty()) << sound;
    EXPECT_THAT(made_faults("docs/b.md", "[`step`](../core/a.hpp#L3)"),
                ElementsAre(HasSubstr("core/a.hpp has 2 lines")));
    EXPECT_THAT(made_faults("docs/b.md", "[`step`](../core/a.hpp#L0)"), SizeIs(1));
    EXPECT_THAT(made_faults("docs/b.md", "[`step`](../core/a.hpp#L2-L3)"), SizeIs(1));
    EXPECT_THAT(made_faults("docs/b.md", "[`step`](../core/a.hpp#L1)"),
                ElementsAre(HasSubstr("line 1 has no 'step'")));
    EXPECT_THAT(made_faults("docs/b.md", "[`Simulation::ste`](../core/a.hpp#L2)"),
                ElementsAre(HasSubstr("line 2 has no 'ste'")));
}

TEST(ReferenceChecker, KnowsFilesByTheirCommonName) {
    EXPECT_THAT(made_faults("docs/b.md", "`core/drive/servo`, `core/drive/`, `core/`"), IsEmpty());
    EXPECT_THAT(made_faults("docs/b.md", "`build/release/grainfield`"), IsEmpty());
    EXPECT_THAT(made_faults("docs/b.md", "`core/drive/gone`"),
                ElementsAre(HasSubstr("core/drive/gone: neither")));
}

}  // namespace
}  // namespace grainfield::repository
