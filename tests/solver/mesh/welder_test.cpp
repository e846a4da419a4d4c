#include "solver/mesh/welder.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace patchlight::welder_test {
namespace {

constexpr double reach = 1e-3;

TEST(Welder, NumbersPointsInTheOrderTheyCome) {
    Welder welder({reach});
    EXPECT_EQ(welder.add(Vec3(0, 0, 0), 0), 0u);
    EXPECT_EQ(welder.add(Vec3(1, 0, 0), 0), 1u);
    EXPECT_EQ(welder.add(Vec3(0, 0, 0), 0), 0u);
    EXPECT_EQ(welder.take_points(), (std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0)}));
}

TEST(Welder, MakesOneOfPointsWithinReachWhereverCellsEnd) {
    Welder welder({reach});
    std::mt19937 chance(1);
    for (int n = 0; n < 20000; ++n) {  // reach is a 16th of a cell: some thousand straddle walls
        const Vec3 p = 20.0 * Vec3(uniform(chance) - 0.5, uniform(chance) - 0.5, uniform(chance));
        const std::uint32_t number = welder.add(p, 0);
        EXPECT_EQ(welder.add(p + 0.99 * reach * random_direction(chance), 0), number);
    }
}

TEST(Welder, KeepsPointsBeyondReachApart) {
    std::mt19937 chance(2);
    for (int n = 0; n < 2000; ++n) {
        Welder welder({reach});
        const Vec3 p = 20.0 * Vec3(uniform(chance) - 0.5, uniform(chance) - 0.5, uniform(chance));
        const Vec3 q = p + 1.01 * reach * random_direction(chance);
        EXPECT_NE(welder.add(p, 0), welder.add(q, 0));
    }
}

TEST(Welder, KeepsTheFirstPosition) {
    Welder welder({reach});
    welder.add(Vec3(1, 2, 3), 0);
    welder.add(Vec3(1 + 0.5 * reach, 2, 3), 0);
    EXPECT_EQ(welder.take_points(), std::vector<Vec3>{Vec3(1, 2, 3)});
}

TEST(Welder, WorksFarFromTheOrigin) {
    Welder welder({1e-9});  // of a scene of size 1, ten thousand sizes away
    const Vec3 far(1e4, -1e4, 1e4);
    EXPECT_EQ(welder.add(far, 0), welder.add(far + Vec3(0.0, 0.0, 5e-10), 0));
    EXPECT_NE(welder.add(far, 0), welder.add(far + Vec3(0.0, 0.0, 1e-6), 0));
}

TEST(Welder, OfTwoFramesMakesOneOfWhatIsTheSameExactlyAndOfNothingElse) {
    Welder welder({1e-9, 10.0});
    const std::uint32_t here = welder.add(Vec3(1, 2, 3), 0);
    EXPECT_EQ(welder.add(Vec3(1, 2, 3), 1), here);
    EXPECT_NE(welder.add(Vec3(1, 2, 3 + 1e-6), 1), here);
    EXPECT_NE(welder.add(Vec3(1, 2, 3 + 2e-6), 0), here);
}

}  // namespace
}  // namespace patchlight::welder_test
