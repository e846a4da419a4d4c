#include "solver/accuracy/next_aim.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::next_aim_test {
namespace {

constexpr double target = 0.01;
using Indirect = GatherAim::Indirect;

struct Rounds {
    NextAim next{target};
    GatherAim aim{0.0025, 0.002, {64, 384}, false, 256, Indirect::anew};
    double less = 1.0;  // of the noise, what was asked for
    bool settles = false;

    void after(const RoundErrors& errors) {
        less = 1.0;
        settles = next.after(
            errors,
            [&](double share) {
                less = share;
                return 2 * aim.rays;
            },
            aim);
    }
};

/// direct, indirect, noise, bent, noise of direct, bent of direct, correction
TEST(NextAim, JoinsRaysWhereNoiseIsWhatWasMissed) {
    Rounds rounds;
    rounds.after({0.001, 0.010, 0.0115, 0.002, 0.0, 0.001, 0.0005});
    EXPECT_EQ(rounds.aim.gathered, Indirect::joined);
    EXPECT_EQ(rounds.aim.rays, 512);
    EXPECT_DOUBLE_EQ(rounds.aim.indirect, 0.002) << "no more vertices";
    EXPECT_DOUBLE_EQ(rounds.aim.direct, 0.0025);
    EXPECT_GE(rounds.less, 0.5);
    EXPECT_LE(rounds.less * 0.010, 0.75 * target) << "enough of them";
}

TEST(NextAim, AsksForVerticesAloneWhereBendsWereMissed) {
    Rounds rounds;
    rounds.after({0.001, 0.012, 0.002, 0.011, 0.0, 0.001, 0.0005});
    EXPECT_LT(rounds.aim.indirect, 0.75 * 0.002);
    EXPECT_EQ(rounds.less, 1.0);
}

TEST(NextAim, SharesWhatMayBeMissedSoThatNoiseGetsMore) {
    Rounds rounds;  // 0.017 of noise, as smoothed, and as much of bends
    rounds.after({0.001, 0.024, 0.02, 0.017, 0.0, 0.001, 0.0005});
    const double of_bends = rounds.aim.indirect / 0.002;
    EXPECT_LT(rounds.less, 1.0);
    EXPECT_LE(of_bends, rounds.less) << "noise costs the more to bring down";
    EXPECT_GE(of_bends, 0.5) << "what was measured is not sure enough for more at once";
}

TEST(NextAim, AsksForLessWhereOnlyDoubtWasTooMuch) {
    Rounds rounds;
    rounds.after({0.001, 0.006, 0.006, 0.003, 0.0, 0.001, 0.0005});
    EXPECT_TRUE(rounds.less < 1.0 || rounds.aim.indirect < 0.002);
}

TEST(NextAim, RefinesDirectLightAloneWhereItAloneIsToBlame) {
    constexpr bool has_gaps = true;
    Rounds rounds;
    rounds.after({0.02, 0.003, 0.003, 0.001, 0.0, 0.02, 0.0005, false, has_gaps});
    EXPECT_EQ(rounds.aim.gathered, Indirect::kept);
    EXPECT_LT(rounds.aim.direct, 0.0025);
    EXPECT_EQ(rounds.aim.effort.first, 64) << "it may have been bends alone";
    rounds.after({0.02, 0.003, 0.003, 0.001, 0.0, 0.02, 0.0005, false, has_gaps});
    EXPECT_EQ(rounds.aim.effort.first, 256) << "it was not";
    EXPECT_TRUE(rounds.aim.direct_anew);
    const double direct = rounds.aim.direct;
    rounds.after({0.02, 0.003, 0.003, 0.001, 0.0, 0.02, 0.0005, false, has_gaps});
    EXPECT_FALSE(rounds.aim.direct_anew);
    EXPECT_LT(rounds.aim.direct, direct) << "bends again";
    EXPECT_EQ(rounds.aim.rays, 256);
}

TEST(NextAim, SamplesAnewWhatNeitherNoiseNorInterpolationOfDirectLightExplain) {
    Rounds rounds;
    const int before = rounds.aim.effort.first;
    rounds.after({0.03, 0.003, 0.003, 0.001, 0.007, 0.005, 0.0005});
    EXPECT_TRUE(rounds.aim.direct_anew) << "samples agreed by chance";
    EXPECT_GT(rounds.aim.effort.first, before);
    EXPECT_DOUBLE_EQ(rounds.aim.direct, 0.0025);
}

TEST(NextAim, CutsAQuarterWhereAHalfWasInVain) {
    const RoundErrors missed{0.03, 0.003, 0.003, 0.001, 0.0, 0.03, 0.0005};
    Rounds rounds;
    const double first = rounds.aim.direct;
    rounds.after(missed);
    const double second = rounds.aim.direct;
    EXPECT_GE(second, 0.5 * first);
    rounds.after(missed);
    EXPECT_FALSE(rounds.aim.direct_anew) << "there are no gaps";
    EXPECT_LT(rounds.aim.direct, 0.49 * second);
    EXPECT_GE(rounds.aim.direct, 0.25 * second);
}

TEST(NextAim, AimsCloserWhereErrorsLightEachOther) {
    const RoundErrors alone{0.001, 0.009, 0.004, 0.008, 0.0, 0.001, 0.0005};
    RoundErrors amplified = alone;
    amplified.amplified = 1.5;
    Rounds one, other;
    one.after(alone);
    other.after(amplified);
    EXPECT_LT(other.aim.indirect, 0.8 * one.aim.indirect);
    // What rays read is wrong as long as it comes to far more than noise and bends.
    amplified.amplified = 4.0;
    Rounds unexplained;
    unexplained.after(amplified);
    EXPECT_TRUE(unexplained.settles);
    EXPECT_DOUBLE_EQ(unexplained.aim.indirect, 0.002);
}

TEST(NextAim, GathersOnFromACoarseSolutionThatIsFine) {
    RoundErrors coarse{0.001, 0.009, 0.002, 0.001, 0.0, 0.001, 0.0005, true};
    coarse.correction = 0.5 * target;
    for (const bool is_fine : {false, true}) {
        coarse.coarse_is_fine = is_fine;
        Rounds rounds;
        rounds.after(coarse);
        EXPECT_EQ(rounds.aim.gathered,
                  is_fine ? GatherAim::Indirect::joined : GatherAim::Indirect::anew);
        rounds.after(coarse);
        EXPECT_EQ(rounds.aim.gathered, GatherAim::Indirect::anew) << "that was not enough";
    }
}

TEST(NextAim, DoesNotCutForNoiseOfLampsThatAreSeenInPart) {
    Rounds rounds;
    rounds.after({0.0052, 0.012, 0.011, 0.002, 0.005, 0.0052, 0.0005});
    EXPECT_DOUBLE_EQ(rounds.aim.direct, 0.0025) << "vertices would not bring it down";
    EXPECT_LT(rounds.less, 1.0);
    EXPECT_LE(std::hypot(rounds.less * 0.0095, 0.0052), 0.9 * target) << "other light makes up";
}

TEST(NextAim, TakesMoreSamplesOfLampsSeenInPartWhereTheirNoiseIsTooMuch) {
    Rounds rounds;
    const int before = rounds.aim.effort.most;
    rounds.after({0.012, 0.003, 0.003, 0.001, 0.011, 0.012, 0.0005});
    EXPECT_GT(rounds.aim.effort.most, before);
    EXPECT_TRUE(rounds.aim.direct_anew) << "samples are not joined";
    EXPECT_DOUBLE_EQ(rounds.aim.direct, 0.0025);
}

TEST(NextAim, DoesNotAskForMoreWhileWhatRaysReadIsWrong) {
    Rounds rounds;
    rounds.after({0.001, 0.1, 0.002, 0.002, 0.0, 0.001, 0.02});
    EXPECT_EQ(rounds.aim.gathered, Indirect::anew);
    EXPECT_EQ(rounds.aim.rays, 256);
    EXPECT_DOUBLE_EQ(rounds.aim.indirect, 0.002);
    rounds.after({0.001, 0.05, 0.002, 0.002, 0.0, 0.001, 0.01});
    EXPECT_EQ(rounds.aim.rays, 256) << "it gets better by itself";
    EXPECT_TRUE(rounds.settles);
    rounds.after({0.001, 0.048, 0.002, 0.002, 0.0, 0.001, 0.009});
    EXPECT_FALSE(rounds.settles) << "it does not any more";
    EXPECT_LT(rounds.aim.indirect, 0.002);
}

TEST(NextAim, ReadsAnewWhereTheRoundChangedMuchAndAfterJoining) {
    Rounds rounds;
    rounds.after({0.001, 0.012, 0.011, 0.002, 0.0, 0.001, 0.0015});
    EXPECT_EQ(rounds.aim.gathered, Indirect::anew) << "15 % of the target were changed";
    rounds.after({0.001, 0.012, 0.011, 0.002, 0.0, 0.001, 0.0005});
    EXPECT_EQ(rounds.aim.gathered, Indirect::joined);
    rounds.after({0.001, 0.011, 0.010, 0.002, 0.0, 0.001, 0.0005});
    EXPECT_EQ(rounds.aim.gathered, Indirect::anew) << "more rays of the same light did not do";
}

TEST(NextAim, ReadsAnewWhereRaysReadTheCoarseSolution) {
    Rounds rounds;
    rounds.after({0.001, 0.012, 0.011, 0.002, 0.0, 0.001, 0.0005, true});
    EXPECT_EQ(rounds.aim.gathered, Indirect::anew);
}

}  // namespace
}  // namespace patchlight::next_aim_test
