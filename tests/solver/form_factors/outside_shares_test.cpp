#include "solver/form_factors/outside_shares.h"

#include "tests/solver/form_factors/matrices.h"

#include <gtest/gtest.h>

namespace patchlight::outside_shares_test {
namespace {

constexpr std::uint64_t rays = 100;

/// Shares and their variances of patches of one cluster.
ExchangeMatrix told(const std::vector<Outside>& outside, double row_sum = 0.0) {
    ExchangeMatrix matrix = empty_matrix(std::vector<double>(outside.size(), 1.0));
    matrix.backs.clear(), matrix.escaped.clear();
    PatchClusters clusters;
    clusters.of_patch.assign(outside.size(), 0);
    clusters.group = {0};
    set_outside(matrix, outside, clusters, std::vector<double>(outside.size(), row_sum));
    return matrix;
}

TEST(SetOutside, TakesTheSharesAsTheyAre) {
    const ExchangeMatrix matrix = told({{0.25, 0.5, rays}, {0.0, 0.75, rays}});
    EXPECT_EQ(matrix.backs, (std::vector<double>{0.25, 0.0}));
    EXPECT_EQ(matrix.escaped, (std::vector<double>{0.5, 0.75}));
}

TEST(SetOutside, WhatNoRayToldIsExact) {
    const ExchangeMatrix matrix = told({{1.0, 0.0, 0}, {0.0, 0.0, 0}});
    EXPECT_EQ(matrix.backs_variance, (std::vector<double>{0.0, 0.0}));
    EXPECT_EQ(matrix.escaped_variance, (std::vector<double>{0.0, 0.0}));
}

TEST(SetOutside, WhatNoneOfAClusterSeesIsCertain) {
    const ExchangeMatrix matrix = told({{0.0, 0.5, rays}, {0.0, 0.5, rays}});
    EXPECT_EQ(matrix.backs_variance, (std::vector<double>{0.0, 0.0}));
}

TEST(SetOutside, AlikePatchesLendEachOtherDoubt) {
    // One of four had no hit by chance: it is not certain of 0.
    const ExchangeMatrix matrix =
        told({{0.0, 0.0, rays}, {0.01, 0.0, rays}, {0.02, 0.0, rays}, {0.01, 0.0, rays}});
    EXPECT_GT(matrix.backs_variance[0], 0.001 / static_cast<double>(rays));
    EXPECT_LT(matrix.backs_variance[0], 0.02 / static_cast<double>(rays));
}

TEST(SetOutside, PatchesThatAreAllOrNothingStandAlone) {
    // The foot of a box: under it nothing but backs, beside it none.
    const ExchangeMatrix matrix =
        told({{1.0, 0.0, rays}, {1.0, 0.0, rays}, {0.0, 0.0, rays}, {0.0, 0.0, rays}});
    for (const double variance : matrix.backs_variance) EXPECT_NEAR(variance, 0.0, 1e-12);
}

TEST(SetOutside, APatchThatAnotherSeesIsNotCertainToLoseAllItsLight) {
    const double seen = 1e-3;
    const ExchangeMatrix matrix = told({{0.0, 1.0, rays}}, seen);
    EXPECT_NEAR(matrix.escaped_variance[0], seen * (1.0 - seen) / static_cast<double>(rays), 1e-12);
    EXPECT_EQ(matrix.backs_variance[0], 0.0);
    EXPECT_EQ(told({{0.0, 1.0, rays}}).escaped_variance[0], 0.0);
}

TEST(SetOutside, OfOneShareAloneTheVarianceIsBinomial) {
    const ExchangeMatrix matrix = told({{0.3, 0.0, rays}});
    EXPECT_NEAR(matrix.backs_variance[0], 0.3 * 0.7 / static_cast<double>(rays), 1e-12);
}

}  // namespace
}  // namespace patchlight::outside_shares_test
