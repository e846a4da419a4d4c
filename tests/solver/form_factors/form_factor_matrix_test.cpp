#include "solver/form_factors/form_factor_matrix.h"

#include "tests/solver/form_factors/engine_scene.h"
#include "tests/solver/form_factors/matrices.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::form_factor_matrix_test {
namespace {

constexpr double rounding = 1e-6;  // float entries

void expect_agrees(const ExchangeMatrix& exchange) {
    const FormFactorMatrix matrix(exchange);
    ASSERT_EQ(matrix.size(), exchange.size());
    for (PatchIndex i = 0; i < matrix.size(); ++i) {
        double sum = 0.0;
        for (PatchIndex j = 0; j < matrix.size(); ++j) {
            const double factor = i == j ? 0.0 : entry(exchange, i, j) / exchange.area[i];
            ASSERT_NEAR(matrix.at(i, j), factor, rounding * factor) << i << ' ' << j;
            sum += matrix.at(i, j);
        }
        EXPECT_NEAR(matrix.row_sum(i), sum, 1e-12);
        if (matrix.is_dense(i)) continue;
        EXPECT_TRUE(std::is_sorted(matrix.columns(i).begin(), matrix.columns(i).end()));
        EXPECT_EQ(matrix.columns(i).size(), matrix.factors(i).size());
    }
}

TEST(FormFactorMatrix, HoldsFullRowsDense) {
    const ExchangeMatrix full = random_closed(40, 1.0, 1);
    expect_agrees(full);
    const FormFactorMatrix matrix(full);
    for (PatchIndex i = 0; i < 40; ++i) {
        ASSERT_TRUE(matrix.is_dense(i));
        EXPECT_EQ(matrix.dense(i).size(), 40u);
    }
}

TEST(FormFactorMatrix, HoldsThinRowsSparse) {
    const ExchangeMatrix thin = random_closed(60, 0.1, 2);
    expect_agrees(thin);
    const FormFactorMatrix matrix(thin);
    for (PatchIndex i = 0; i < 60; ++i) EXPECT_FALSE(matrix.is_dense(i));
}

TEST(FormFactorMatrix, MixesBoth) {
    const ExchangeMatrix mixed = random_closed(50, 0.45, 3);
    expect_agrees(mixed);
    const FormFactorMatrix matrix(mixed);
    int dense = 0;
    for (PatchIndex i = 0; i < 50; ++i) dense += matrix.is_dense(i);
    EXPECT_GT(dense, 0);
    EXPECT_LT(dense, 50);
}

TEST(FormFactorMatrix, HasEmptyRows) {
    ExchangeMatrix matrix = empty_matrix({1.0, 2.0, 4.0});
    add_entry(matrix, 0, 2, 0.5);
    finish(matrix);
    const FormFactorMatrix factors(matrix);
    EXPECT_EQ(factors.row_sum(1), 0.0);
    EXPECT_EQ(factors.at(0, 2), 0.5);
    EXPECT_EQ(factors.at(2, 0), 0.125);
    EXPECT_EQ(factors.at(1, 2), 0.0);
}

}  // namespace
}  // namespace patchlight::form_factor_matrix_test
