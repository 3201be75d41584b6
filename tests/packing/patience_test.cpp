// When shaking has had its chance: for any lid there is an end.
#include "packing/patience.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/base/random.hpp"

namespace grainfield::packing {
namespace {

using Verdict = Patience::Verdict;

/// Bouts until the verdict, the lid being at height(bout); 10,000 if it never comes.
int bouts_until(Verdict verdict, bool friction, const std::function<double(int)>& height) {
    Patience patience(1.0, height(0));
    for (int bout = 1; bout < 10000; ++bout)
        if (patience.after_bout(height(bout), friction) == verdict) return bout;
    return 10000;
}

TEST(Patience, LidThatStandsStillIsStalled) {
    const auto still = [](int) { return 1.2; };
    EXPECT_EQ(bouts_until(Verdict::lower_friction, true, still), 3);
    EXPECT_EQ(bouts_until(Verdict::give_up, false, still), 80);
}

// It once was progress, for ever, that every other bout brought the lid down.
TEST(Patience, LidThatBouncesComesToAnEnd) {
    const auto bouncing = [](int bout) { return bout % 2 ? 1.25 : 1.2; };
    EXPECT_EQ(bouts_until(Verdict::lower_friction, true, bouncing), 20);
    EXPECT_EQ(bouts_until(Verdict::give_up, false, bouncing), 160);
    const core::RandomStream random(1, core::Stream::packing_shaking);
    for (const bool friction : {true, false})
        EXPECT_LT(bouts_until(friction ? Verdict::lower_friction : Verdict::give_up, friction,
                              [&](int bout) {
                                  return 1.2 +
                                         0.05 * random.uniform(0, static_cast<std::uint64_t>(bout));
                              }),
                  500);
}

TEST(Patience, LidThatComesDownIsShakenOn) {
    // Bouncing by 0.01 about a mean that comes down by 0.001 in two bouts.
    const auto sinking = [](int bout) { return 3 - 5e-4 * bout + (bout % 2 ? 0.01 : 0); };
    Patience patience(1.0, sinking(0));
    for (int bout = 1; bout < 3900; ++bout) {
        ASSERT_EQ(patience.after_bout(sinking(bout), bout % 3 == 0), Verdict::go_on) << bout;
        ASSERT_LE(patience.lowest(), sinking(bout));
    }
    EXPECT_EQ(patience.bouts(), 3899);
    // In every bout by a little more than what counts as progress.
    const auto steady = [](int bout) { return 30 - 2.1e-3 * bout; };
    EXPECT_EQ(bouts_until(Verdict::lower_friction, true, steady), 10000);
}

TEST(Patience, LidThatHardlyComesDownIsFruitless) {
    // Every other bout it is lower than ever, by a ten-thousandth of what counts as progress.
    const auto creeping = [](int bout) { return 1.2 - 1e-7 * bout + (bout % 2 ? 0.05 : 0); };
    EXPECT_EQ(bouts_until(Verdict::lower_friction, true, creeping), 20);
    EXPECT_EQ(bouts_until(Verdict::give_up, false, creeping), 160);
}

TEST(Patience, EveryFrictionHasItsChance) {
    Patience stalled(1.0, 1.2), bouncing(1.0, 1.2);
    for (int bout = 1; bout <= 60; ++bout) {
        EXPECT_EQ(stalled.after_bout(1.2, true) == Verdict::lower_friction, bout % 3 == 0) << bout;
        EXPECT_EQ(bouncing.after_bout(bout % 2 ? 1.25 : 1.2, true) == Verdict::lower_friction,
                  bout % 20 == 0)
            << bout;
    }
}

TEST(Patience, ReachingTheHeightOfTheBlockCountsAnew) {
    Patience patience(1.0, 1.2);
    const auto bouncing = [](int bout) { return bout % 2 ? 1.25 : 1.2; };
    for (int bout = 1; bout < 150; ++bout)
        ASSERT_EQ(patience.after_bout(bouncing(bout), false), Verdict::go_on) << bout;
    patience.reached(1.0);
    EXPECT_EQ(patience.lowest(), 1.0);
    // Lower than before, but not below the height that was reached.
    int more = 1;
    while (patience.after_bout(bouncing(more) - 0.1, false) == Verdict::go_on) ++more;
    EXPECT_EQ(more, 160);
}

}  // namespace
}  // namespace grainfield::packing
