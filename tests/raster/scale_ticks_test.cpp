#include "raster/scale_ticks.h"

#include <gtest/gtest.h>

namespace patchlight::raster::scale_ticks_test {
namespace {

std::string labels(double least, double most, int most_ticks) {
    std::string all;
    for (const Tick& tick : scale_ticks(least, most, most_ticks))
        all += (all.empty() ? "" : " ") + tick.label;
    return all;
}

TEST(ScaleTicks, StandAtRoundNumbers) {
    EXPECT_EQ(labels(0, 500, 7), "0 100 200 300 400 500");
    EXPECT_EQ(labels(0, 2.5, 7), "0.0 0.5 1.0 1.5 2.0 2.5");
    EXPECT_EQ(labels(0, 1.5, 7), "0.00 0.25 0.50 0.75 1.00 1.25 1.50");
    EXPECT_EQ(labels(0, 60, 7), "0 10 20 30 40 50 60");
    EXPECT_EQ(labels(0, 0.003, 7), "0.0000 0.0005 0.0010 0.0015 0.0020 0.0025 0.0030");
    EXPECT_EQ(labels(0, 500, 3), "0 200 400");
    EXPECT_EQ(labels(0, 500, 0), "0 500");
}

TEST(ScaleTicks, LieWithinTheRange) {
    EXPECT_EQ(labels(13, 487, 7), "100 200 300 400");
    EXPECT_EQ(labels(0.3, 0.7, 9), "0.30 0.35 0.40 0.45 0.50 0.55 0.60 0.65 0.70");
    EXPECT_EQ(labels(1000, 1001, 3), "1000.0 1000.5 1001.0");
}

TEST(ScaleTicks, LongNumbersAreWrittenShort) {
    EXPECT_EQ(labels(0, 2e6, 5), "0 5e+05 1e+06 1.5e+06 2e+06");
    EXPECT_EQ(labels(0, 4e-5, 5), "0 1e-05 2e-05 3e-05 4e-05");
}

TEST(ScaleTicks, PlacesAreWhatLabelsSay) {
    for (const Tick& tick : scale_ticks(0, 2.5, 7))
        EXPECT_DOUBLE_EQ(tick.place, std::stod(tick.label));
}

TEST(ScaleTicks, RoundNumbersAreNotBelow) {
    EXPECT_DOUBLE_EQ(round_number_above(487.0), 500.0);
    EXPECT_DOUBLE_EQ(round_number_above(500.0), 500.0);
    EXPECT_DOUBLE_EQ(round_number_above(501.0), 600.0);
    EXPECT_DOUBLE_EQ(round_number_above(1.01), 1.5);
    EXPECT_DOUBLE_EQ(round_number_above(9.0), 10.0);
    EXPECT_DOUBLE_EQ(round_number_above(0.00021), 0.00025);
}

}  // namespace
}  // namespace patchlight::raster::scale_ticks_test
