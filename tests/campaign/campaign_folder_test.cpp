// Who may work in a campaign's folder, and what belongs there.

#include <gmock/gmock.h>

#include <optional>

#include "core/files/text_file.hpp"
#include "tests/config/config_fixture.hpp"
#include "triaxial/campaign/campaign_folder.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;

class Folder : public ConfigTest {
  protected:
    std::vector<CampaignCase> cases(const std::string& more = "") const {
        return load_campaign(write("c.toml", "field.variable = 'stiffness'\n" + more));
    }
    CampaignFolder open(const std::vector<CampaignCase>& all, const Shard& shard = {},
                        const std::string& name = "out") const {
        return {folder_ / name, all, std::nullopt, shard};
    }
    std::string results(const std::string& name = "out") const {
        return core::read_whole_file(folder_ / name / "results.csv");
    }
};

Row row(std::int64_t k, const std::string& name = "base") {
    Row r;
    r.case_name = name;
    r.realization = k;
    r.E50 = 1e7 + static_cast<double>(k);
    return r;
}

TEST_F(Folder, TwoProcessesDoNotShareItUnlessTheyAreOtherShards) {
    const auto all = cases();
    {
        const CampaignFolder first = open(all);
        EXPECT_THAT(message_of<InputError>([&] { open(all); }), HasSubstr("already"));
        EXPECT_THAT(message_of<InputError>([&] { open(all, {1, 2}); }), HasSubstr("already"));
    }
    const CampaignFolder shard = open(all, {1, 2});
    EXPECT_NO_THROW(open(all, {2, 2}));
    EXPECT_THROW(open(all, {1, 2}), InputError);
    EXPECT_THROW(open(all), InputError);
}

TEST_F(Folder, ResultsAreSortedAndEachRowStandsOnce) {
    const auto all = cases("montecarlo.realizations = 30\n");
    {
        CampaignFolder folder = open(all, {1, 2});
        folder.append({{row(10), row(2), row(deterministic_run)}});
        CampaignFolder other = open(all, {2, 2});
        other.append({{row(2), row(29), row(30)}});  // 30: beyond what is asked for
        other.write_results();
    }
    const std::string text = results();
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
    EXPECT_LT(text.find("base,2,"), text.find("base,10,"));
    EXPECT_LT(text.find("base,10,"), text.find("base,29,"));
    EXPECT_THAT(core::read_whole_file(folder_ / "out" / "deterministic.csv"),
                HasSubstr("base,-1,"));
    EXPECT_EQ(open(all).finished().size(), 4u);
}

TEST_F(Folder, ResultsHaveAColumnForEverySweptKey) {
    const auto all = cases(
        "[montecarlo.sweep]\n'field.stiffness.cov' = [0.4, 0.8]\n"
        "[[montecarlo.case]]\nname = 'long'\n"
        "set = { 'field.correlation_length' = [5.0, 0.5, 5.0], 'packing.spheres' = 100 }\n"
        "[[montecarlo.case]]\nname = 'paper'\nset = { 'field.method' = 'cholesky' }\n");
    CampaignFolder folder = open(all);
    Row failed = row(1, "paper cov=0.4");
    failed.failed = true;
    folder.append({{row(0, "long cov=0.8"), failed}});
    folder.write_results();
    const std::string text = results();
    EXPECT_THAT(
        text,
        HasSubstr(
            "wall_seconds,state_hash,failure,end_reason,field.correlation_length,field.method,"
            "field.stiffness.cov,packing.spheres\n"));
    EXPECT_THAT(text,
                HasSubstr("long cov=0.8,0,0,done,0,10000000,0,0,0,0,,,,5x0.5x5,las,0.8,100\n"));
    EXPECT_THAT(text, HasSubstr("paper cov=0.4,1,0,failed,,,,,,0,,,,10x1x10,cholesky,0.4,\n"));
    EXPECT_THAT(core::read_whole_file(folder_ / "out" / "deterministic.csv"),
                testing::EndsWith("field.stiffness.cov,packing.spheres\n"));
}

TEST_F(Folder, AnotherCampaignIsRefusedByName) {
    { open(cases()); }
    EXPECT_THAT(message_of<InputError>([&] { open(cases("particle.density = 2500\n")); }),
                testing::AllOf(HasSubstr("density = 2600"), HasSubstr("density = 2500")));
    EXPECT_THAT(message_of<InputError>([&] { open(cases("solver.precision = 'double'\n")); }),
                HasSubstr("precision"));
    // What a file of measured values says is part of the campaign, not only its name.
    write("cpt.csv", "x,y,z,value,error\n0,0,0,9e8,0\n");
    const std::string key = "field.data = 'cpt.csv'\n";
    { open(cases(key), {}, "data"); }
    EXPECT_NO_THROW(open(cases(key), {}, "data"));
    write("cpt.csv", "x,y,z,value,error\n0,0,0,8e8,0\n");
    EXPECT_THAT(message_of<InputError>([&] { open(cases(key), {}, "data"); }),
                HasSubstr("the values in the file of field.data were others"));
    // More realizations, other cases: the same campaign.
    EXPECT_NO_THROW(open(cases("montecarlo.realizations = 500\n")));
    EXPECT_NO_THROW(open(cases("[[montecarlo.case]]\nname = 'other'\n")));
    // Those that were there before are remembered.
    EXPECT_THROW(open(cases("particle.density = 2500\n")), InputError);
    EXPECT_THAT(message_of<InputError>([&] { open(cases("solver.isa = 'scalar'\n")); }),
                HasSubstr("there isa = \"auto\""));
    for (const char* damaged : {"{", "[1]", "{}", "{\"cases\": 1}"}) {
        write("out/campaign.json", damaged);
        EXPECT_THAT(message_of<FileError>([&] { open(cases()); }),
                    HasSubstr("campaign.json: damaged; it is not what a campaign wrote"));
    }
}

TEST_F(Folder, WhatAKillLeftUnwrittenOfItsCasesComesBack) {
    const auto all = cases();
    { open(all); }
    const auto file = folder_ / "out" / "cases" / "base.toml";
    const std::string before = core::read_whole_file(file);
    std::filesystem::remove_all(folder_ / "out" / "cases");
    { open(all); }
    EXPECT_EQ(core::read_whole_file(file), before);
}

TEST_F(Folder, CasesOfDifferentCallsDoNotShareFiles) {
    { open(cases("[[montecarlo.case]]\nname = 'a b'\n")); }
    EXPECT_THAT(message_of<InputError>([&] { open(cases("[[montecarlo.case]]\nname = 'a_b'\n")); }),
                HasSubstr("\"a b\" and \"a_b\" would share their files"));
}

TEST_F(Folder, MergingTakesRowsOverOnce) {
    const auto all = cases();
    {
        CampaignFolder other = open(all, {2, 2}, "other");
        Row failed = row(3);
        failed.failed = true;
        failed.reason = "lost a \"sphere\"";
        Row doubtful = row(1);
        doubtful.warnings = {"not \"held\"", "too fast"};
        other.append({{row(0), doubtful, failed}});
        std::filesystem::create_directories(folder_ / "other" / "failed");
        write("other/failed/base-3.h5", "state");
    }
    CampaignFolder folder = open(all);
    folder.append({{row(0)}});
    EXPECT_EQ(folder.merge(folder_ / "other"), 2u);
    EXPECT_EQ(folder.merge(folder_ / "other"), 0u);
    folder.write_results();
    EXPECT_EQ(folder.finished().size(), 3u);
    EXPECT_THAT(core::read_whole_file(folder_ / "out" / "failures.csv"),
                HasSubstr("base,3,\"lost a 'sphere'\",failed/base-3.h5"));
    EXPECT_EQ(core::read_whole_file(folder_ / "out" / "warnings.csv"),
              "case,realization,warning\nbase,1,\"not 'held'\"\nbase,1,\"too fast\"\n");
    EXPECT_EQ(core::read_whole_file(folder_ / "out" / "failed" / "base-3.h5"), "state");
    { open(cases("particle.density = 2500\n"), {}, "stranger"); }
    EXPECT_THROW(folder.merge(folder_ / "stranger"), InputError);
}

}  // namespace
}  // namespace grainfield::triaxial
