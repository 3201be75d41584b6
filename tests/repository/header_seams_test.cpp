// Headers stay cheap to include and in order: large libraries are read by source files only, and no
// header includes itself by way of others.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/repository/include_rules.hpp"
#include "tests/repository/source_tree.hpp"

namespace grainfield::repository {
namespace {

using testing::IsEmpty;

/// Operands of the includes of a file, as they are written.
std::vector<std::string> includes_of(const SourceFile& file) {
    static const std::regex include(R"re(^\s*#\s*include\s*([<"][^>"]+[>"]).*)re");
    std::vector<std::string> operands;
    std::smatch match;
    for (const std::string& line : split_lines(file.text))
        if (std::regex_match(line, match, include)) operands.push_back(match[1].str());
    return operands;
}

/// Why a file should not include this; empty: it may.
std::string seam_fault(const std::string& path, const std::string& operand) {
    const std::string parser = "triaxial/cli/argument_parser.cpp";
    if (operand.starts_with("<CLI/") && path != parser)
        return path + " includes CLI11, which is for " + parser;
    static const std::regex large("<(toml\\+\\+/.*|nlohmann/json\\.hpp)>");
    if (path.ends_with(".hpp") && first_folder(path) != "tests" && std::regex_match(operand, large))
        return path + " is a header and includes " + operand;
    return "";
}

using Graph = std::map<std::string, std::vector<std::string>>;

/// A way from `at` to a file that is on the way already; empty: there is none.
std::string cycle_from(const Graph& graph, const std::string& at, std::vector<std::string>& way,
                       std::set<std::string>& done) {
    if (done.contains(at)) return "";
    way.push_back(at);
    const auto node = graph.find(at);
    for (const std::string& next :
         node == graph.end() ? std::vector<std::string>() : node->second) {
        if (std::find(way.begin(), way.end(), next) != way.end()) return next + " by " + at;
        if (const std::string found = cycle_from(graph, next, way, done); !found.empty())
            return found;
    }
    way.pop_back();
    done.insert(at);
    return "";
}

std::string cycle_in(const Graph& graph) {
    std::vector<std::string> way;
    std::set<std::string> done;
    for (const auto& [path, next] : graph)
        if (const std::string found = cycle_from(graph, path, way, done); !found.empty())
            return found;
    return "";
}

TEST(HeaderSeams, LargeLibrariesAreReadBySourceFilesOnly) {
    for (const SourceFile& file : text_files(GRAINFIELD_SOURCE_DIR)) {
        if (!is_cpp(file.path)) continue;
        for (const std::string& operand : includes_of(file))
            EXPECT_THAT(seam_fault(file.path, operand), IsEmpty());
    }
}

TEST(HeaderSeams, NoHeaderIncludesItselfThroughOthers) {
    Graph graph;
    for (const SourceFile& file : text_files(GRAINFIELD_SOURCE_DIR)) {
        if (!file.path.ends_with(".hpp")) continue;
        for (const std::string& operand : includes_of(file))
            if (operand.front() == '"')
                graph[file.path].push_back(operand.substr(1, operand.size() - 2));
    }
    EXPECT_GT(graph.size(), 100u);
    EXPECT_THAT(cycle_in(graph), IsEmpty());
}

TEST(HeaderSeamsChecker, FindsEveryKindOfFault) {
    EXPECT_FALSE(seam_fault("bench/soak.cpp", "<CLI/CLI.hpp>").empty());
    EXPECT_FALSE(seam_fault("triaxial/cli/a.hpp", "<CLI/CLI.hpp>").empty());
    EXPECT_FALSE(seam_fault("triaxial/a.hpp", "<toml++/toml.h>").empty());
    EXPECT_FALSE(seam_fault("core/a.hpp", "<nlohmann/json.hpp>").empty());
    EXPECT_TRUE(seam_fault("core/a.hpp", "<nlohmann/json_fwd.hpp>").empty());
    EXPECT_TRUE(seam_fault("core/a.cpp", "<nlohmann/json.hpp>").empty());
    EXPECT_TRUE(seam_fault("tests/a.hpp", "<nlohmann/json.hpp>").empty());
    EXPECT_EQ(includes_of({"a.hpp", "#include <map>\n  # include \"b.hpp\"  // why\nint i;\n"}),
              (std::vector<std::string>{"<map>", "\"b.hpp\""}));
    EXPECT_EQ(cycle_in({{"a", {"b", "c"}}, {"b", {"c"}}, {"c", {"d"}}}), "");
    EXPECT_EQ(cycle_in({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), "b by c");
    EXPECT_EQ(cycle_in({{"a", {"a"}}}), "a by a");
}

}  // namespace
}  // namespace grainfield::repository
