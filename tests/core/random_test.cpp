// Random numbers: known answers, accuracy of the normals, distribution and independence.

#include "core/base/random.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "core/base/normal_quantile.hpp"
#include "tests/larger.hpp"

namespace grainfield::core {
namespace {

using Words = std::array<std::uint32_t, 4>;

// kat_vectors of Random123, philox4x32 10.
TEST(Random, PhiloxGivesThePublishedAnswers) {
    EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}),
              (Words{0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u}));
    EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
              (Words{0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu}));
    EXPECT_EQ(
        philox({0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u}, {0xa4093822u, 0x299f31d0u}),
        (Words{0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u}));
}

// A seed must mean the same for ever: regression values, not analytic ones.
TEST(Random, KeyIsSeedAndStreamAndCounterIsRealizationAndIndex) {
    const RandomStream stream(7, Stream::packing_grading);
    const std::uint64_t realization = 0x0000000500000006u;
    const std::uint64_t index = 0x0000000300000004u;
    EXPECT_EQ(stream.bits(realization, index), philox({4, 3, 6, 5}, {7, 3}));
}

TEST(Random, NormalQuantileAgreesWithBoost) {
    const boost::math::normal_distribution<long double> reference;
    double worst = 0.0;
    const auto check = [&](double p) {
        const auto exact = static_cast<double>(quantile(reference, static_cast<long double>(p)));
        const double error = std::abs(normal_quantile(p) - exact);
        // Seven multiplications and additions of positive terms, a division and a logarithm: a few
        // units of round-off each.
        EXPECT_LE(error, 1.2e-15 * std::abs(exact)) << "p = " << p;
        if (exact != 0.0) worst = larger(worst, error / std::abs(exact));
    };
    for (int i = 1; i < 4000; ++i) check(i / 4000.0);
    for (int e = 2; e <= 53; ++e) {
        check(std::ldexp(1.0, -e));
        check(std::ldexp(1.5, -e - 1));
        check(1.0 - std::ldexp(1.0, -e));
    }
    RecordProperty("worst_relative_error", std::to_string(worst));
    EXPECT_EQ(normal_quantile(0.5), 0.0);
    EXPECT_EQ(normal_quantile(0.25), -normal_quantile(0.75));
}

// Normals drawn together are those drawn one by one, to the last bit: in vectors, in their odd
// ends, across blocks and threads, in the tails, and where the index passes 32 bits.
TEST(Random, ManyNormalsAreTheSameAsSingleOnes) {
    const RandomStream stream(20240607, Stream::field_stiffness);
    std::size_t different = 0, tails = 0;
    for (const std::size_t count : {1u, 3u, 8u, 9u, 255u, 257u, 40000u}) {
        for (const std::uint64_t first : {0ull, 5ull, 0xFFFFFFF0ull, 0xFFFFFFFFFFull}) {
            std::vector<double> values(count);
            stream.normals(77, first, values);
            for (std::size_t i = 0; i < count; ++i) {
                different += values[i] != stream.normal(77, first + i);
                tails += std::abs(values[i]) > 3.0;
            }
        }
    }
    EXPECT_EQ(different, 0u);
    EXPECT_GT(tails, 100u);
}

// The same on every instruction set that this machine has, the plain one included.
TEST(Random, NormalsAreTheSameOnEveryInstructionSet) {
    const RandomStream stream(20240607, Stream::field_friction);
    const std::vector<double> usual = [&] {
        std::vector<double> values(30001);
        stream.normals(5, 3, values);
        return values;
    }();
    const std::int64_t all = hwy::SupportedTargets();
    int sets = 0;
    for (const std::int64_t target :
         {std::int64_t{HWY_AVX3}, std::int64_t{HWY_AVX2}, std::int64_t{HWY_STATIC_TARGET}}) {
        if ((all & target) == 0) continue;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        std::vector<double> values(usual.size());
        stream.normals(5, 3, values);
        EXPECT_EQ(values, usual) << hwy::TargetName(target);
        ++sets;
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    EXPECT_GE(sets, 1);
}

// The tails' own logarithm against the library's, over all that a uniform number can be there.
TEST(Random, TailLogarithmIsGoodToTwoUnitsOfRoundOff) {
    for (int e = 4; e <= 1022; e = e < 60 ? e + 1 : e + 31) {
        for (int i = 0; i < 50; ++i) {
            const double x = std::ldexp(1.0 + i / 50.0, -e);
            EXPECT_NEAR(as241::tail_log(x), std::log(x), 4.5e-16 * std::abs(std::log(x))) << x;
        }
    }
}

TEST(Random, UniformsAreInsideTheOpenInterval) {
    const RandomStream stream(1, Stream::packing_position);
    for (std::uint64_t i = 0; i < 100000; ++i) {
        const double u = stream.uniform(0, i);
        ASSERT_GT(u, 0.0);
        ASSERT_LT(u, 1.0);
    }
    EXPECT_EQ(stream.uniform(3, 9), stream.uniform_pair(3, 9)[0]);
    EXPECT_TRUE(std::isfinite(normal_quantile(0x1p-53)));
    EXPECT_TRUE(std::isfinite(normal_quantile(1.0 - 0x1p-53)));
}

TEST(Random, StreamsSeedsRealizationsAndIndicesAllDiffer) {
    std::set<Words> seen;
    int count = 0;
    for (const std::uint64_t seed : {0ull, 1ull, 2ull, 1ull << 32, (1ull << 32) + 1, ~0ull}) {
        for (const auto stream : {Stream::field_friction, Stream::field_stiffness}) {
            const RandomStream random(seed, stream);
            for (std::uint64_t realization = 0; realization < 5; ++realization) {
                for (std::uint64_t index = 0; index < 5; ++index, ++count) {
                    seen.insert(random.bits(realization, index));
                }
            }
        }
    }
    EXPECT_EQ(static_cast<int>(seen.size()), count);
}

// Pearson's chi-squared over 1000 equally likely classes, at a significance of 1e-6 either side.
TEST(Random, NormalsFollowTheirDistribution) {
    const int classes = 1000;
    const int samples = 1000000;
    std::vector<int> found(classes, 0);
    const RandomStream stream(42, Stream::field_friction);
    std::vector<double> values(samples);
    stream.normals(3, 10, values);
    EXPECT_EQ(values[5], stream.normal(3, 15));
    for (const double x : values) {
        const double p = 0.5 * std::erfc(-x / std::sqrt(2.0));
        ++found[static_cast<std::size_t>(std::min(classes - 1, static_cast<int>(p * classes)))];
    }
    double chi2 = 0.0;
    const double expected = static_cast<double>(samples) / classes;
    for (const int n : found) chi2 += (n - expected) * (n - expected) / expected;
    const boost::math::chi_squared distribution(classes - 1);
    EXPECT_GT(chi2, quantile(distribution, 1e-6));
    EXPECT_LT(chi2, quantile(complement(distribution, 1e-6)));
}

// Neighbouring counters must not be correlated: r sqrt(n) is standard normal, 4.9 is 1e-6.
TEST(Random, NeighbouringIndicesRealizationsAndStreamsAreUncorrelated) {
    const RandomStream a(42, Stream::field_friction);
    const RandomStream b(42, Stream::field_stiffness);
    const RandomStream c(43, Stream::field_friction);
    const int n = 200000;
    double next = 0.0, realization = 0.0, stream = 0.0, seed = 0.0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const double x = a.normal(0, i);
        next += x * a.normal(0, i + 1);
        realization += x * a.normal(1, i);
        stream += x * b.normal(0, i);
        seed += x * c.normal(0, i);
    }
    for (const double sum : {next, realization, stream, seed}) {
        EXPECT_LT(std::abs(sum) / std::sqrt(static_cast<double>(n)), 4.9);
    }
}

}  // namespace
}  // namespace grainfield::core
