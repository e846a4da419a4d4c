#include "solver/form_factors/join_halves.h"

#include "tests/solver/form_factors/engine_scene.h"
#include "tests/solver/form_factors/matrices.h"

#include <gtest/gtest.h>

namespace patchlight::join_halves_test {
namespace {

constexpr double rounding = 1e-6;  // float entries

/// Full rows of three patches: F_01 = 0.3, F_10 = 0.1, F_02 = 0.2 and nothing back, F_21 = 0.05.
ExchangeMatrix counted() {
    ExchangeMatrix rows = empty_matrix({1.0, 2.0, 4.0});
    add_entry(rows, 0, 1, 0.3 * 1.0, 0.01 * 1.0, 1.0);
    add_entry(rows, 0, 2, 0.2 * 1.0, 0.02 * 1.0, 1.0);
    add_entry(rows, 1, 0, 0.1 * 2.0, 0.03 * 4.0, 2.0);
    add_entry(rows, 2, 1, 0.05 * 4.0, 0.04 * 16.0, 4.0);
    finish(rows);
    return rows;
}

TEST(JoinHalves, PoolsTheHitsOfBothEnds) {
    ExchangeMatrix matrix = counted();
    join_halves(matrix, std::vector<int>(matrix.size(), 1));
    ASSERT_EQ(matrix.column, (std::vector<PatchIndex>{1, 2, 2}));
    EXPECT_EQ(matrix.start, (std::vector<std::size_t>{0, 2, 3, 3}));
    // H = (F_ij + F_ji) / (1/A_i + 1/A_j)
    EXPECT_NEAR(entry(matrix, 0, 1), 0.4 / 1.5, rounding);
    EXPECT_NEAR(entry(matrix, 0, 2), 0.2 / 1.25, rounding);
    EXPECT_NEAR(entry(matrix, 1, 2), 0.05 / 0.75, rounding);
}

TEST(JoinHalves, PoolsTheirVariances) {
    ExchangeMatrix matrix = counted();
    join_halves(matrix, std::vector<int>(matrix.size(), 1));
    EXPECT_NEAR(matrix.variance[0], 0.04 / (1.5 * 1.5), rounding);
    EXPECT_NEAR(matrix.variance[1], 0.02 / (1.25 * 1.25), rounding);
}

TEST(JoinHalves, NoPairExchangesMoreThanTheSmallerArea) {
    ExchangeMatrix matrix = counted();
    join_halves(matrix, std::vector<int>(matrix.size(), 1));
    EXPECT_EQ(matrix.ceiling, (std::vector<float>{1.0f, 1.0f, 2.0f}));
}

TEST(JoinHalves, OfEqualAreasIsTheMeanWithHalfTheVariance) {
    ExchangeMatrix matrix = empty_matrix({1.0, 1.0});
    add_entry(matrix, 0, 1, 0.30, 0.01);
    add_entry(matrix, 1, 0, 0.20, 0.01);
    finish(matrix);
    join_halves(matrix, std::vector<int>(matrix.size(), 1));
    EXPECT_NEAR(entry(matrix, 0, 1), 0.25, rounding);
    EXPECT_NEAR(matrix.variance[0], 0.005, rounding);
}

TEST(JoinHalves, ARowOfMoreSamplesCountsMore) {
    ExchangeMatrix matrix = empty_matrix({1.0, 1.0});
    add_entry(matrix, 0, 1, 0.30, 0.01);
    add_entry(matrix, 1, 0, 0.20, 0.04);
    finish(matrix);
    join_halves(matrix, {4, 1});
    EXPECT_NEAR(entry(matrix, 0, 1), 0.28, rounding);
    EXPECT_NEAR(matrix.variance[0], (16 * 0.01 + 0.04) / 25, rounding);
}

TEST(MeasureRows, TellsTheDefectsOfTheRowsAsCounted) {
    const std::vector<std::optional<Outside>> outside{Outside{0.25, 0.25, 8}, Outside{0.0, 0.9, 8},
                                                      Outside{0.5, 0.0, 8}};
    const ClosureReport report = measure_rows(counted(), outside);
    EXPECT_NEAR(report.row_sum_min, 0.05, rounding);
    EXPECT_NEAR(report.row_sum_max, 0.5, rounding);
    EXPECT_NEAR(report.row_sum_mean, (0.5 * 1 + 0.1 * 2 + 0.05 * 4) / 7, rounding);
    EXPECT_NEAR(report.closure_max, 0.45, rounding);     // of row 2
    EXPECT_NEAR(report.reciprocity_max, 0.2, rounding);  // of pair 0, 2 over the smaller area
}

}  // namespace
}  // namespace patchlight::join_halves_test
