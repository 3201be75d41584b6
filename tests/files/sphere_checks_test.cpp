#include "core/files/sphere_checks.hpp"

#include <limits>
#include <vector>

#include "core/base/errors.hpp"
#include "tests/files/sample.hpp"

namespace grainfield::core {
namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Spheres of radius 1 m and 0.5 m by turns on a line, at these x [m].
ParticleStore line_of(const std::vector<double>& x) {
    ParticleStore s;
    s.resize(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
        s.position.x[i] = x[i];
        s.radius[i] = i % 2 == 0 ? 1.0 : 0.5;
    }
    return s;
}

TEST(CheckSpheres, TakesAGoodSample) {
    EXPECT_NO_THROW(check_spheres(make_sample(100).spheres, "a"));
}

TEST(CheckSpheres, NamesSphereLineAndNumber) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<std::int32_t> lines{2, 5};
    const auto say = [&](auto spoil) {
        ParticleStore s = line_of({0, 10});
        spoil(s);
        return message_of<InputError>([&] { check_spheres(s, "a.csv", lines); });
    };
    EXPECT_EQ(say([](auto& s) { s.resize(0); }), "a.csv: no sphere; at least one needed");
    EXPECT_EQ(say([](auto& s) { s.radius[1] = 0; }),
              "a.csv: sphere 1 (line 5): radius = 0: must be > 0 m");
    EXPECT_EQ(say([](auto& s) { s.radius[0] = -2; }),
              "a.csv: sphere 0 (line 2): radius = -2: must be > 0 m");
    EXPECT_EQ(say([](auto& s) { s.radius[0] = infinity; }),
              "a.csv: sphere 0 (line 2): radius = inf: must be > 0 m");
    EXPECT_EQ(say([](auto& s) { s.position.z[1] = nan; }),
              "a.csv: sphere 1 (line 5): z = nan: must be a finite number [m]");
    EXPECT_EQ(say([](auto& s) { s.spin.y[1] = -infinity; }),
              "a.csv: sphere 1 (line 5): wy = -inf: must be a finite number [rad/s]");
    EXPECT_EQ(say([](auto& s) { s.mass[1] = -1; }),
              "a.csv: sphere 1 (line 5): mass = -1: must be >= 0 kg");
    EXPECT_EQ(say([](auto& s) { s.normal_stiffness[1] = nan; }),
              "a.csv: sphere 1 (line 5): normal_stiffness = nan: must be >= 0 Pa");
    EXPECT_EQ(say([](auto& s) { s.friction_angle[1] = 2; }),
              "a.csv: sphere 1 (line 5): friction_angle = 2: must be >= 0 and < pi/2 rad");
    ParticleStore s = line_of({0, nan});
    EXPECT_EQ(message_of<InputError>([&] { check_spheres(s, "a.h5"); }),
              "a.h5: sphere 1: x = nan: must be a finite number [m]");
}

// Radii 1 m and 0.5 m: the limit is an overlap of 0.05 m, so a distance of 1.45 m.
TEST(CheckOverlaps, AllowsATenthOfTheSmallerRadius) {
    EXPECT_NO_THROW(check_overlaps(line_of({0, 1.4501}), Pairs{{0, 1}}, "a"));
    EXPECT_NO_THROW(check_overlaps(line_of({0, 1}), Pairs{}, "a"));
    EXPECT_THROW(check_overlaps(line_of({0, 1.4499}), Pairs{{0, 1}}, "a"), InputError);
    EXPECT_THROW(check_overlaps(line_of({1, 1}), Pairs{{1, 0}}, "a"), InputError);
}

TEST(CheckOverlaps, NamesTheWorstPairWhateverTheOrder) {
    const ParticleStore s = line_of({0, 1.375, 3, 4.25});
    const std::vector<std::int32_t> lines{2, 3, 5, 6};
    const std::string expected =
        "a.csv: sphere 2 (line 5) and sphere 3 (line 6) overlap by 0.25 m = 50 % of the smaller "
        "radius 0.5 m; allowed: 10 % (2 such pairs)";
    for (const Pairs& pairs : {Pairs{{0, 1}, {1, 2}, {2, 3}}, Pairs{{3, 2}, {1, 0}},
                               Pairs{{0, 1}, {2, 3}, {3, 2}, {1, 0}, {0, 3}}})
        EXPECT_EQ(message_of<InputError>([&] { check_overlaps(s, pairs, "a.csv", lines); }),
                  expected);
    EXPECT_EQ(message_of<InputError>([&] {
                  check_overlaps(s, Pairs{{1, 0}}, "a.h5");
              }),
              "a.h5: sphere 0 and sphere 1 overlap by 0.125 m = 25 % of the smaller radius 0.5 m; "
              "allowed: 10 % (1 such pair)");
}

}  // namespace
}  // namespace grainfield::core
