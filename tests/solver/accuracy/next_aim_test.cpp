#include "solver/accuracy/next_aim.h"

#include <gtest/gtest.h>

namespace patchlight {
namespace {

constexpr double target = 0.01;
using Indirect = GatherAim::Indirect;

struct Rounds {
    NextAim next{target};
    GatherAim aim{0.0025, 0.002, {64, 384}, 256, Indirect::anew};
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

TEST(NextAim, JoinsRaysWhereNoiseIsWhatWasMissed) {
    Rounds rounds;
    rounds.after({0.001, 0.012, 0.011, 0.002, 0.0005});
    EXPECT_EQ(rounds.aim.gathered, Indirect::joined);
    EXPECT_EQ(rounds.aim.rays, 512);
    EXPECT_DOUBLE_EQ(rounds.aim.indirect, 0.002) << "no more vertices";
    EXPECT_DOUBLE_EQ(rounds.aim.direct, 0.0025);
    EXPECT_GE(rounds.less, 0.3);
    EXPECT_LE(rounds.less * 0.012, 0.8 * target) << "enough of them";
}

TEST(NextAim, AsksForVerticesAndSomeRaysWhereBendsWereMissed) {
    Rounds rounds;
    rounds.after({0.001, 0.012, 0.002, 0.011, 0.0005});
    EXPECT_LT(rounds.aim.indirect, 0.002);
    EXPECT_LT(rounds.less, 1.0);
    EXPECT_GT(rounds.less, rounds.aim.indirect / 0.002);
}

TEST(NextAim, RefinesDirectLightAloneWhereItAloneIsToBlame) {
    Rounds rounds;
    rounds.after({0.02, 0.004, 0.004, 0.001, 0.0005});
    EXPECT_EQ(rounds.aim.gathered, Indirect::kept);
    EXPECT_LT(rounds.aim.direct, 0.0025);
    EXPECT_EQ(rounds.aim.effort.first, 128);
    EXPECT_EQ(rounds.aim.rays, 256);
}

TEST(NextAim, DoesNotAskForMoreWhileWhatRaysReadIsWrong) {
    Rounds rounds;
    rounds.after({0.001, 0.1, 0.002, 0.002, 0.02});
    EXPECT_EQ(rounds.aim.gathered, Indirect::anew);
    EXPECT_EQ(rounds.aim.rays, 256);
    EXPECT_DOUBLE_EQ(rounds.aim.indirect, 0.002);
    rounds.after({0.001, 0.05, 0.002, 0.002, 0.01});
    EXPECT_EQ(rounds.aim.rays, 256) << "it gets better by itself";
    EXPECT_TRUE(rounds.settles);
    rounds.after({0.001, 0.048, 0.002, 0.002, 0.009});
    EXPECT_EQ(rounds.aim.rays, 512) << "it does not any more";
    EXPECT_FALSE(rounds.settles);
    EXPECT_LT(rounds.aim.indirect, 0.002);
}

TEST(NextAim, ReadsAnewWhereTheRoundChangedMuchAndAfterJoining) {
    Rounds rounds;
    rounds.after({0.001, 0.012, 0.011, 0.002, 0.004});
    EXPECT_EQ(rounds.aim.gathered, Indirect::anew) << "40 % of the target were changed";
    rounds.after({0.001, 0.012, 0.011, 0.002, 0.0005});
    EXPECT_EQ(rounds.aim.gathered, Indirect::joined);
    rounds.after({0.001, 0.011, 0.010, 0.002, 0.0005});
    EXPECT_EQ(rounds.aim.gathered, Indirect::anew) << "more rays of the same light did not do";
}

}  // namespace
}  // namespace patchlight
