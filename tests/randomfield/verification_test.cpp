// The verification finds what is wrong, and seldom what is not.

#include "randomfield/verification/verification.hpp"

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/randomfield/field_support.hpp"

namespace grainfield::randomfield {
namespace {

std::size_t outside(const FieldCheck& check) {
    std::size_t count = 0;
    for (const CorrelationEstimates& axis : check.correlation)
        for (const Estimate& one : axis) count += one.inside() ? 0 : 1;
    return count;
}

std::size_t outside(const HistogramCheck& check) {
    std::size_t count = (check.mean.inside() ? 0 : 1) +
                        (check.deviation_judged && !check.deviation.inside() ? 1 : 0);
    for (const Estimate& share : check.shares) count += share.inside() ? 0 : 1;
    return count;
}

FieldOptions paper(Variable variable, double theta_y) {
    FieldOptions options;
    options.variable = variable;
    options.correlation_length = paper_theta(theta_y);
    return options;
}

TEST(Verification, FindsNothingWrongWithTheExactField) {
    FieldOptions options = paper(Variable::both, 0.5);
    options.cross_correlation = 0.6;
    options.stiffness.mean_gradient = 1e8;
    const Verification result = verify(FieldGenerator(GridSpec{}, options), 400);
    ASSERT_EQ(result.fields.size(), 2u);
    EXPECT_LT(result.covariance_error->covariance, 1e-12);
    ASSERT_TRUE(result.cross_correlation);
    EXPECT_TRUE(result.cross_correlation->inside());
    EXPECT_DOUBLE_EQ(result.cross_correlation->exact, 0.6);
    for (const FieldCheck& field : result.fields) {
        EXPECT_EQ(outside(field), 0u);
        EXPECT_EQ(field.variance.outside, 0u);
        EXPECT_EQ(outside(*field.histogram), 0u);
        EXPECT_EQ(field.correlation[0].size(), 6u);
        EXPECT_EQ(field.correlation[1].size(), 12u);
        // docs/method.md, section 5.2: correlation of cells one apart, in x and y.
        EXPECT_NEAR(field.correlation[0][1].exact, 0.9764, 0.5e-4);
        EXPECT_NEAR(field.correlation[1][1].exact, 0.5477, 0.5e-4);
        // Bands that say something.
        EXPECT_LT(field.correlation[1][1].high - field.correlation[1][1].low, 0.3);
        EXPECT_TRUE(field.histogram->deviation_judged);
        const Estimate& deviation = field.histogram->deviation;
        EXPECT_LT((deviation.high - deviation.low) / deviation.exact, 0.4);
    }
}

// Subdivision as published, 3 x 6 x 3 -> 6 x 12 x 6: largest covariance error 0.396 of gamma.
TEST(Verification, FindsTheErrorOfSubdivision) {
    FieldOptions options = paper(Variable::friction, 0.1);
    options.method = Method::las_classic;
    options.stage0_cells = 54;
    const Verification result = verify(FieldGenerator(GridSpec{}, options), 400);
    EXPECT_NEAR(result.covariance_error->covariance, 0.396, 0.5e-3);
    EXPECT_GT(outside(result.fields.front()), 2u);
    EXPECT_EQ(result.fields.front().variance.outside, 0u);  // exact after one split
}

// After several splits the variances are off too, and so is what is distributed by them.
TEST(Verification, FindsWrongVariances) {
    FieldOptions options = paper(Variable::friction, 0.1);
    options.method = Method::las_classic;
    options.stage0_cells = 1;
    const Verification result = verify(FieldGenerator(GridSpec{}, options), 2000);
    EXPECT_GT(result.covariance_error->variance, 0.05);
    EXPECT_GT(result.fields.front().variance.outside, 10u);
}

/// Checks of a field, by name, that are outside in one verification.
struct Alarms {
    std::size_t correlation = 0, variance = 0, histogram = 0, mean = 0, deviation = 0, cross = 0;

    void add(const Verification& result) {
        for (const FieldCheck& field : result.fields) {
            correlation += outside(field) > 0 ? 1 : 0;
            variance += field.variance.outside > 0 ? 1 : 0;
            std::size_t bins = 0;
            for (const Estimate& share : field.histogram->shares) bins += share.inside() ? 0 : 1;
            histogram += bins > 0 ? 1 : 0;
            mean += field.histogram->mean.inside() ? 0 : 1;
            deviation += field.histogram->deviation_judged && !field.histogram->deviation.inside();
        }
        cross += result.cross_correlation && !result.cross_correlation->inside() ? 1 : 0;
    }
};

// Checks that are held to be wrong 1 % of the time: of 300, 14 and more are so once in 1e5 (the
// binomial distribution; 16 checks here). From few realizations, where hardly a bin has five
// entries, to fields of one value each and of independent cells.
TEST(Verification, RaisesFewFalseAlarms) {
    struct Setting {
        double theta_y;
        std::uint64_t realizations;
        double gradient;
    };
    for (const Setting& setting : {Setting{0.3, 100, 0.0}, Setting{1000.0, 100, 0.0},
                                   Setting{0.01, 100, 1e8}, Setting{1.0, 300, 0.0}}) {
        Alarms alarms;
        for (std::uint64_t seed = 1; seed <= 150; ++seed) {
            FieldOptions options = paper(Variable::both, setting.theta_y);
            options.seed = seed;
            options.cross_correlation = 0.5;
            options.stiffness.mean_gradient = setting.gradient;
            alarms.add(verify(FieldGenerator({{3, 4, 2}, Vec3(0.25, 0.25, 0.25)}, options),
                              setting.realizations));
        }
        SCOPED_TRACE(setting.theta_y);
        EXPECT_LT(alarms.correlation, 14u);
        EXPECT_LT(alarms.variance, 14u);
        EXPECT_LT(alarms.histogram, 14u);
        EXPECT_LT(alarms.mean, 14u);
        EXPECT_LT(alarms.deviation, 14u);
        EXPECT_LT(alarms.cross, 9u);  // of 150
    }
}

// Fields of one generator held against what another one should give. Each is wrong by an amount
// that 1,000 realizations show beyond doubt, and only what it is wrong in is outside.
TEST(Verification, FindsWhatIsWrong) {
    const GridSpec grid{{3, 4, 2}, Vec3(0.25, 0.25, 0.25)};
    FieldOptions right = paper(Variable::both, 0.3);
    right.cross_correlation = 0.5;
    right.seed = 2;
    const FieldGenerator expected(grid, right);
    core::Monitor nobody;
    const auto alarms_of = [&](const FieldOptions& wrong) {
        const FieldGenerator other(grid, wrong);
        const auto draw = [&](std::uint64_t k) { return other.draw(k); };
        Alarms alarms;
        alarms.add(verify(expected, {draw, draw}, 1000, nobody));
        return alarms;
    };
    const Alarms none = alarms_of(right);
    EXPECT_EQ(
        none.correlation + none.variance + none.histogram + none.mean + none.deviation + none.cross,
        0u);

    FieldOptions wrong = right;
    wrong.correlation_length = paper_theta(0.5);
    EXPECT_EQ(alarms_of(wrong).correlation, 2u);

    wrong = right;
    wrong.cross_correlation = 0.4;
    const Alarms cross = alarms_of(wrong);
    EXPECT_EQ(cross.cross, 1u);
    EXPECT_EQ(cross.correlation + cross.histogram + cross.mean, 0u);

    wrong = right;
    wrong.stiffness.mean *= 1.08;
    const Alarms mean = alarms_of(wrong);
    EXPECT_EQ(mean.mean, 1u);
    EXPECT_EQ(mean.correlation + mean.variance + mean.cross, 0u);

    wrong = right;
    wrong.friction.s = 2.4;  // wider by a fifth, of the same mean
    const Alarms wider = alarms_of(wrong);
    EXPECT_GE(wider.histogram, 1u);
    EXPECT_EQ(wider.deviation, 1u);
    EXPECT_EQ(wider.mean + wider.correlation, 0u);

    wrong = right;  // of the same mean and nearly the same deviation, in another shape
    wrong.stiffness = {MarginalKind::weibull, {}, {}, 2.0, 9e8, 0.8};
    EXPECT_GE(alarms_of(wrong).histogram, 1u);
}

// Where many values are the bounds themselves, bins fall together; no edge is twice there.
TEST(Verification, BinsOfValuesAtTheBounds) {
    FieldOptions options = paper(Variable::friction, 0.3);
    options.friction.s = 1e6;
    const Verification result =
        verify(FieldGenerator({{3, 4, 2}, Vec3(0.25, 0.25, 0.25)}, options), 300);
    const HistogramCheck& histogram = *result.fields.front().histogram;
    double share = 0.0, exact = 0.0;
    for (std::size_t b = 0; b < histogram.shares.size(); ++b) {
        share += histogram.shares[b].estimate;
        exact += histogram.shares[b].exact;
        if (b < 2) continue;
        EXPECT_GT(histogram.edges[b - 1], histogram.edges[b - 2]);
    }
    EXPECT_NEAR(share, 1.0, 1e-12);
    EXPECT_NEAR(exact, 1.0, 1e-9);
    EXPECT_EQ(histogram.shares.size(), 2u);  // minimum and maximum
    EXPECT_EQ(outside(histogram), 0u);
}

TEST(Verification, ChecksTheDataTheyAreConditionedOn) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("grainfield_verify_" + std::to_string(getpid()) + ".csv");
    const auto with = [&](const char* lines) {
        std::ofstream(file) << "x,y,z,value,error\n" << lines;
        FieldOptions options = paper(Variable::friction, 0.5);
        options.data = file.string();
        return FieldGenerator(GridSpec{}, options);
    };
    const FieldGenerator right = with("0.1,0.1,0.1,0.7,0\n0.8,1.6,0.8,0.5,0.01\n");
    const FieldGenerator other_value = with("0.1,0.1,0.1,0.7001,0\n0.8,1.6,0.8,0.5,0.01\n");
    const FieldGenerator other_mean = with("0.1,0.1,0.1,0.7,0\n0.8,1.6,0.8,0.51,0.01\n");
    const FieldGenerator other_error = with("0.1,0.1,0.1,0.7,0\n0.8,1.6,0.8,0.5,0.02\n");
    std::filesystem::remove(file);
    const auto check = [&](const FieldGenerator& drawn) {
        core::Monitor nobody;
        const Verification result =
            verify(right,
                   {[&](std::uint64_t k) { return drawn.draw_unconditional(k); },
                    [&](std::uint64_t k) { return drawn.draw(k); }},
                   300, nobody);
        EXPECT_EQ(outside(result.fields.front()), 0u);  // of the field without data
        return result.fields.front().data.value();
    };
    const DataCheck good = check(right);
    EXPECT_EQ(good.cells, 2u);
    EXPECT_EQ(good.exact, 1u);
    EXPECT_LT(good.largest_miss, 1e-12);
    EXPECT_LT(good.mean_off, good.mean_allowed);
    EXPECT_EQ(good.variance.outside, 0u);
    EXPECT_TRUE(std::isnan(good.variance.ratio[0]));

    EXPECT_NEAR(check(other_value).largest_miss, 1e-4 / 0.7, 1e-9);
    const DataCheck mean = check(other_mean);
    EXPECT_GT(mean.mean_off, mean.mean_allowed);
    EXPECT_LT(mean.largest_miss, 1e-12);
    EXPECT_GT(check(other_error).variance.outside, 0u);
}

TEST(Verification, IsTheSameOnAnyNumberOfThreads) {
    const FieldGenerator generator(GridSpec{}, paper(Variable::none, 0.5));
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    const Verification one = verify(generator, 100);
    omp_set_num_threads(3);
    const Verification three = verify(generator, 100);
    omp_set_num_threads(before);
    EXPECT_EQ(one.fields[0].variance.ratio, three.fields[0].variance.ratio);
    EXPECT_EQ(one.fields[0].correlation[1][5].estimate, three.fields[0].correlation[1][5].estimate);
    EXPECT_EQ(one.fields[0].correlation[1][5].high, three.fields[0].correlation[1][5].high);
    EXPECT_FALSE(one.fields[0].histogram);
    EXPECT_NE(input_error([&] { verify(generator, 99); }).find("--realizations = 99"),
              std::string::npos);
}

}  // namespace
}  // namespace grainfield::randomfield
