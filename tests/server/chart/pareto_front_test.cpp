#include "server/chart/pareto_front.h"

#include <gtest/gtest.h>

namespace patchlight::server::pareto_front_test {
namespace {

using Front = std::vector<std::size_t>;

TEST(ParetoFront, HoldsWhatNothingBeatsQuickestFirst) {
    const std::vector<SpeedAndError> points{{3.0, 0.1}, {1.0, 0.4}, {2.0, 0.5}, {2.5, 0.2}};
    EXPECT_EQ(pareto_front(points), (Front{1, 3, 0}));
}

TEST(ParetoFront, OfEquallyQuickPointsTheOneWithLessErrorIsOnIt) {
    const std::vector<SpeedAndError> points{{1.0, 0.4}, {1.0, 0.3}, {2.0, 0.3}};
    EXPECT_EQ(pareto_front(points), (Front{1}));
}

TEST(ParetoFront, OfEqualPointsTheFirstCounts) {
    const std::vector<SpeedAndError> points{{1.0, 0.4}, {1.0, 0.4}};
    EXPECT_EQ(pareto_front(points), (Front{0}));
}

TEST(ParetoFront, ErrorsOfZeroEndIt) {
    const std::vector<SpeedAndError> points{{2.0, 0.0}, {1.0, 0.4}, {3.0, 0.0}};
    EXPECT_EQ(pareto_front(points), (Front{1, 0}));
}

TEST(ParetoFront, NothingHasNone) { EXPECT_TRUE(pareto_front({}).empty()); }

}  // namespace
}  // namespace patchlight::server::pareto_front_test
