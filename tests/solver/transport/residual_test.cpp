#include "solver/transport/residual.h"

#include "solver/transport/gauss_seidel.h"
#include "tests/solver/form_factors/matrices.h"
#include "tests/solver/transport/problems.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::residual_test {
namespace {

constexpr double rounding = 1e-12;

TEST(Residual, IsWhatTheEquationLacks) {
    const auto owned = random_problem(40, 0.5, 3, 0.9, 1);
    const Residual residual = measure_residual(owned->problem, owned->problem.exitance);
    for (std::size_t c = 0; c < 3; ++c)
        for (PatchIndex i = 0; i < 40; ++i) {
            double gathered = 0.0;
            for (PatchIndex j = 0; j < 40; ++j)
                gathered += owned->factors.at(i, j) * owned->problem.exitance[c][j];
            EXPECT_NEAR(residual.irradiance[c][i], gathered, rounding);
            EXPECT_NEAR(residual.residual[c][i], owned->problem.reflectance[c][i] * gathered,
                        rounding);
        }
}

TEST(Residual, OfTheSolutionIsNothing) {
    const auto owned = random_problem(40, 0.5, 3, 0.9, 2);
    const Residual residual = measure_residual(owned->problem, solve_directly(owned->problem));
    EXPECT_LT(residual.relative, rounding);
    ASSERT_TRUE(residual.algebraic_bound.has_value());
    EXPECT_LT(*residual.algebraic_bound, rounding);
}

TEST(AlgebraicBound, IsAbsentBeforeMuchIsKnown) {
    const auto owned = random_problem(40, 0.5, 1, 0.99, 3);
    EXPECT_FALSE(measure_residual(owned->problem, owned->problem.exitance).algebraic_bound);
}

class BoundOf : public testing::TestWithParam<std::size_t> {};  // channels

TEST_P(BoundOf, HoldsAndIsNoWorseThanItsTheorySays) {
    int bounds = 0;
    for (unsigned seed = 1; seed <= 100; ++seed) {
        const double most = 0.5 + 0.49 * std::sqrt(0.01 * seed);  // up to 0.99
        const auto owned = random_problem(40, 0.6, GetParam(), most, seed);
        const Field exact = solve_directly(owned->problem);
        const double q = contraction(owned->problem);
        Field radiosity = owned->problem.exitance;
        for (int sweep = 0; sweep < 30; ++sweep) {
            gauss_seidel_sweep(owned->problem, radiosity);
            const auto bound = measure_residual(owned->problem, radiosity).algebraic_bound;
            if (!bound || *bound < 1e-9) continue;
            ++bounds;
            const double error = relative_error(owned->problem, radiosity, exact);
            EXPECT_LE(error, *bound) << seed << ' ' << sweep;
            // ‖r‖ <= (1 + q) ‖e‖; the last factor is what the denominator's own error may add.
            if (GetParam() > 1) continue;  // channels' errors may cancel in the luminance
            EXPECT_LE(*bound, (1 + q) / (1 - q) * error * (1 + 2 * *bound)) << seed << ' ' << sweep;
        }
    }
    EXPECT_GT(bounds, 500);
}

INSTANTIATE_TEST_SUITE_P(AlgebraicBound, BoundOf, testing::Values(std::size_t{1}, std::size_t{3}));

TEST(AlgebraicBound, HoldsForAnyFieldNotOnlyForSweeps) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        std::mt19937 chance(seed);
        std::normal_distribution<double> normal;
        const auto owned = random_problem(30, 0.6, 3, 0.95, seed);
        const Field exact = solve_directly(owned->problem);
        Field radiosity = exact;
        for (auto& channel : radiosity)
            for (double& b : channel) b += 0.01 * normal(chance);
        const auto bound = measure_residual(owned->problem, radiosity).algebraic_bound;
        EXPECT_LE(relative_error(owned->problem, radiosity, exact), bound.value_or(1e300)) << seed;
    }
}

TEST(Contraction, IsTheLargestReflectanceTimesTheLargestRowSum) {
    ExchangeMatrix open = empty_matrix({1.0, 2.0});
    add_entry(open, 0, 1, 0.5);
    finish(open);
    OwnedProblem owned(open, 3);
    owned.problem.reflectance = {{0.2, 0.9}, {0.4, 0.3}, {0.0, 0.0}};
    EXPECT_NEAR(contraction(owned.problem), 0.9 * 0.5, rounding);
}

TEST(LuminanceWeight, SumsToOne) {
    EXPECT_EQ(luminance_weight(0, 1), 1.0);
    EXPECT_NEAR(luminance_weight(0, 3) + luminance_weight(1, 3) + luminance_weight(2, 3), 1.0,
                1e-15);
}

}  // namespace
}  // namespace patchlight::residual_test
