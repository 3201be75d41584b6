// Which runs a campaign has, and which rows each of them fills.

#include <gmock/gmock.h>

#include <set>

#include "tests/config/config_fixture.hpp"
#include "triaxial/campaign/plan.hpp"
#include "triaxial/campaign/row.hpp"

namespace grainfield::triaxial {
namespace {

using ::testing::HasSubstr;

class Plan : public ConfigTest {
  protected:
    std::vector<CampaignCase> cases(const std::string& text) const {
        return load_campaign(write("campaign.toml", text));
    }
};

std::vector<std::string> names(const std::vector<CampaignCase>& cases) {
    std::vector<std::string> result;
    for (const CampaignCase& one : cases) result.push_back(one.name);
    return result;
}

TEST_F(Plan, CasesAreThoseOfTheFileCrossedWithTheSweep) {
    const auto all = cases(R"(
[montecarlo.sweep]
"field.stiffness.cov" = [0.4, 0.8]
field.correlation_length = [[10, 1, 10], [5.0, 0.5, 5.0]]
[[montecarlo.case]]
name = "A"
set = { "field.variable" = "friction" }
[[montecarlo.case]]
name = "B"
set.field.variable = "stiffness"
)");
    EXPECT_THAT(
        names(all),
        testing::ElementsAre(
            "A correlation_length=10x1x10 cov=0.4", "A correlation_length=10x1x10 cov=0.8",
            "A correlation_length=5x0.5x5 cov=0.4", "A correlation_length=5x0.5x5 cov=0.8",
            "B correlation_length=10x1x10 cov=0.4", "B correlation_length=10x1x10 cov=0.8",
            "B correlation_length=5x0.5x5 cov=0.4", "B correlation_length=5x0.5x5 cov=0.8"));
    EXPECT_EQ(all[3].config.field.variable, randomfield::Variable::friction);
    EXPECT_EQ(all[3].config.field.stiffness.cov, 0.8);
    EXPECT_EQ(all[3].config.field.correlation_length, Vec3(5, 0.5, 5));
    EXPECT_EQ(all[4].config.field.variable, randomfield::Variable::stiffness);
    EXPECT_EQ(all[4].config.field.correlation_length, Vec3(10, 1, 10));
}

TEST_F(Plan, WithoutSweepOrCasesThereIsOneCalledBase) {
    EXPECT_THAT(names(cases("")), testing::ElementsAre("base"));
}

TEST_F(Plan, SweptKeysOfOneNameGoByTheirPaths) {
    EXPECT_THAT(names(cases("[montecarlo.sweep]\n'particle.friction_angle' = [0.5]\n"
                            "'wall.friction_angle' = [0.1]\n")),
                testing::ElementsAre("particle.friction_angle=0.5 wall.friction_angle=0.1"));
}

TEST_F(Plan, MistakesOfACaseNameIt) {
    EXPECT_THAT(message_of<InputError>([&] {
                    cases(
                        "[[montecarlo.case]]\nname = 'narrow'\n"
                        "set.field.friction = { minimum = 0.95 }\n");
                }),
                testing::AllOf(HasSubstr("case \"narrow\""), HasSubstr("minimum")));
    EXPECT_THAT(message_of<InputError>([&] { cases("[[montecarlo.case]]\nname = 'a,b'\n"); }),
                HasSubstr("letters, digits"));
    EXPECT_THAT(message_of<InputError>(
                    [&] { cases("[montecarlo.sweep]\n'field.stiffness.cov' = [0.4, 0.4]\n"); }),
                HasSubstr("cov=0.4"));
}

/// Every row once, whichever shards there are.
TEST_F(Plan, ShardsShareEveryRowOut) {
    const auto all = cases(
        "field.variable = 'stiffness'\nmontecarlo.realizations = 7\n"
        "[montecarlo.sweep]\n'field.stiffness.cov' = [0.4, 0.8, 1.2]\n");
    for (const std::int32_t shards : {1, 2, 5, 9}) {
        std::multiset<RowPlace> rows;
        for (std::int32_t shard = 1; shard <= shards; ++shard)
            for (const Job& job : plan_campaign(all, {shard, shards}))
                rows.insert(job.rows.begin(), job.rows.end());
        EXPECT_EQ(rows.size(), 3u * 8u);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::int64_t k = deterministic_run; k < 7; ++k)
                EXPECT_EQ(rows.count({c, k}), 1u) << c << ' ' << k << " of " << shards;
    }
}

TEST_F(Plan, RunsThatAreTheSameAreComputedOnce) {
    const std::string sweep =
        "[montecarlo.sweep]\n'field.stiffness.cov' = [0.4, 0.8]\n"
        "'triaxial.confining_stress' = [1e5, 2e5]\n";
    // Two deterministic runs for four cases: the coefficient of variation does not matter.
    const auto random = plan_campaign(
        cases("field.variable = 'stiffness'\nmontecarlo.realizations = 3\n" + sweep), {});
    EXPECT_EQ(random.size(), 2u + 4u * 3u);
    EXPECT_EQ(random[0].rows,
              (std::vector<RowPlace>{{0, deterministic_run}, {2, deterministic_run}}));
    // Nothing is random: one run a confining stress.
    const auto none = plan_campaign(cases("montecarlo.realizations = 3\n" + sweep), {});
    EXPECT_EQ(none.size(), 2u);
    EXPECT_EQ(none[0].rows.size(), 2u * 4u);
}

TEST_F(Plan, CasesShareTheStartsThatTheyCanShare) {
    const auto all = cases(
        "field.variable = 'stiffness'\n[montecarlo.sweep]\n"
        "'field.stiffness.cov' = [0.4, 0.8]\n"
        "'triaxial.confining_stress' = [1e5, 2e5]\n"
        "'triaxial.strain_rate' = [0.1, 0.2]\n'packing.seed' = [1, 2]\n");
    std::set<std::string> starts, packings;
    for (const CampaignCase& one : all) {
        starts.insert(start_inputs(one.config).hash);
        packings.insert(packing_inputs(one.config).hash);
    }
    EXPECT_EQ(starts.size(), 4u);
    EXPECT_EQ(packings.size(), 2u);
}

}  // namespace
}  // namespace grainfield::triaxial
