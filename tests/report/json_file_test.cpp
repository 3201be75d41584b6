// Summaries that other scripts may have written: what is missing, and what is of the wrong kind.

#include "triaxial/report/json_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "tests/message_of.hpp"
#include "tests/report/run_fixture.hpp"

namespace grainfield::triaxial::report {
namespace {

using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

class JsonFileTest : public testing::Test {
  protected:
    JsonFile file(const std::string& text) const {
        const auto path = folder_.path() / "summary.json";
        triaxial::fixture::write_file(path, text);
        return JsonFile(path);
    }

  private:
    triaxial::fixture::TestFolder folder_;
};

TEST_F(JsonFileTest, FindsKeysInTables) {
    const JsonFile json = file(R"({"a": {"b": 2.5, "text": "t", "flag": true}, "list": [1, 2],
                                   "words": ["x", "y"], "none": null, "n": 7})");
    EXPECT_EQ(json.number("a.b"), 2.5);
    EXPECT_EQ(json.optional_text("a.text"), "t");
    EXPECT_EQ(json.optional_text("n"), "7");
    EXPECT_EQ(json.optional_flag("a.flag"), true);
    EXPECT_THAT(json.numbers("list"), ElementsAre(1, 2));
    EXPECT_THAT(json.texts("words"), ElementsAre("x", "y"));
    for (const char* key : {"none", "missing", "a.missing", "a.b.c"}) {
        EXPECT_FALSE(json.optional_number(key)) << key;
        EXPECT_FALSE(json.optional_text(key)) << key;
        EXPECT_FALSE(json.optional_flag(key)) << key;
    }
    EXPECT_THAT(json.texts("missing"), IsEmpty());
}

TEST_F(JsonFileTest, NamesTheKeyOfWhatIsWrong) {
    const JsonFile json = file(R"({"text": "t", "none": null, "table": {"x": 1, "y": "z"},
                                   "mixed": [1, "two"]})");
    const auto say = [](auto read) { return message_of<FileError>(read); };
    EXPECT_THAT(say([&] { json.number("x"); }), EndsWith("summary.json: key 'x' is missing"));
    EXPECT_THAT(say([&] { json.number("none"); }), HasSubstr("must be a number, is null"));
    EXPECT_THAT(say([&] { json.number("text"); }), HasSubstr("must be a number, is \"t\""));
    EXPECT_THAT(say([&] { json.optional_text("table"); }), HasSubstr("must be text or a number"));
    EXPECT_THAT(say([&] { json.optional_flag("text"); }), HasSubstr("true or false, is \"t\""));
    EXPECT_THAT(say([&] { json.numbers("x"); }), HasSubstr("is missing"));
    EXPECT_THAT(say([&] { json.numbers("text"); }), HasSubstr("must be an array of numbers"));
    EXPECT_THAT(say([&] { json.numbers("mixed"); }), HasSubstr("numbers only, holds \"two\""));
    EXPECT_THAT(say([&] { json.texts("text"); }), HasSubstr("an array of texts is expected"));
    EXPECT_THAT(say([&] { json.texts("mixed"); }), HasSubstr("an array of texts is expected"));
    EXPECT_THAT(say([&] { json.members("x"); }), HasSubstr("an object is expected"));
    EXPECT_THAT(say([&] { json.members("text"); }), HasSubstr("an object is expected"));
    EXPECT_THAT(say([&] { json.members("table"); }), HasSubstr("its entries must be objects"));
    EXPECT_THAT(say([&] { file("[1]"); }), HasSubstr("must hold one JSON object, not array"));
    EXPECT_THAT(say([&] { file("{"); }), HasSubstr("not valid JSON"));
}

TEST_F(JsonFileTest, ListsMembersAndLeaves) {
    const JsonFile json = file(R"({"cases": {"b": {"k": 1}, "a": {"k": "x"}}})");
    const auto members = json.members("cases");
    ASSERT_EQ(members.size(), 2u);
    EXPECT_EQ(members[0].first, "b") << "in the order of the file";
    EXPECT_THAT(json.flattened(), ElementsAre(Pair("cases.b.k", "1"), Pair("cases.a.k", "x")));
}

}  // namespace
}  // namespace grainfield::triaxial::report
