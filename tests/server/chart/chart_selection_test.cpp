#include "server/chart/chart_selection.h"

#include "tests/server/chart/charts.h"

#include <gtest/gtest.h>

namespace patchlight::server::chart_selection_test {
namespace {

TEST(MarkPoints, SortsThemAndTellsFrontAndFloor) {
    const Chart chart = small_chart();
    std::vector<double> seconds, on_front, at_floor;
    for (const ChartPoint& point : chart.points) {
        seconds.push_back(point.seconds);
        if (point.is_on_front) on_front.push_back(point.seconds);
        if (point.is_at_floor) at_floor.push_back(point.seconds);
    }
    EXPECT_EQ(seconds, (std::vector<double>{0.05, 0.125, 0.2, 0.5, 0.6, 4.0}));
    EXPECT_EQ(on_front, (std::vector<double>{0.05, 0.125, 0.2, 0.5, 4.0}));
    EXPECT_EQ(at_floor, (std::vector<double>{4.0}));  // 0.0009 is below twice 0.0008
}

TEST(MarkPoints, PointsWithoutAnErrorAreOnNoFront) {
    Chart chart = small_chart();
    for (ChartPoint& point : chart.points) point.error.reset();
    mark_points(chart);
    for (const ChartPoint& point : chart.points) EXPECT_FALSE(point.is_on_front);
}

TEST(ChartSelection, TheMiddleTimeIsThatOfTheMiddleAccuracy) {
    EXPECT_EQ(middle_time(small_chart()), 0.5);
    EXPECT_FALSE(middle_time(Chart{}));
}

TEST(ChartSelection, WithinATimeTheLeastErrorOfEachSeriesCounts) {
    const Chart chart = small_chart();
    const std::vector<Selected> selected = best_within_time(chart, 0.5);
    ASSERT_EQ(selected.size(), 3u);  // series that were measured
    EXPECT_EQ(selected[0].point->error, 0.005);
    EXPECT_EQ(selected[1].point->error, 0.06);
    EXPECT_EQ(selected[2].series, 2u);
    EXPECT_EQ(selected[2].point, nullptr);  // 0.6 s is more than a tenth too long
    EXPECT_NE(best_within_time(chart, 0.55)[2].point, nullptr);
}

TEST(ChartSelection, TheCommonErrorIsOneThatEverySeriesCameDownTo) {
    const Chart chart = small_chart();
    EXPECT_EQ(common_error(chart), 0.1);
    const std::vector<Selected> selected = quickest_within_error(chart, 0.1);
    EXPECT_EQ(selected[0].point->seconds, 0.2);
    EXPECT_EQ(selected[1].point->seconds, 0.05);
    EXPECT_EQ(selected[2].point->seconds, 0.6);
    EXPECT_EQ(quickest_within_error(chart, 0.01)[1].point, nullptr);
}

TEST(ChartSelection, AutomaticIsHeldAgainstWhatErrsNoMore) {
    const AutomaticScore score = score_automatic(small_chart());
    EXPECT_EQ(score.points, 3);
    EXPECT_EQ(score.on_front, 3);
    EXPECT_EQ(score.unmatched, 2);
    EXPECT_DOUBLE_EQ(score.least_gain, 3.0);  // 0.6 s where auto takes 0.2 s to 4 %
    EXPECT_DOUBLE_EQ(score.most_gain, 3.0);
}

}  // namespace
}  // namespace patchlight::server::chart_selection_test
