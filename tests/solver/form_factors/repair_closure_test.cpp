#include "solver/form_factors/repair_closure.h"

#include "tests/solver/form_factors/engine_scene.h"
#include "tests/solver/form_factors/matrices.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

namespace patchlight::repair_closure_test {
namespace {

constexpr double closed = 1e-6;  // float entries: a row of many sums to 1 this well
constexpr double noise = 0.05;   // of an entry, relative

/// A closed matrix with noise on all entries but every `exact`-th; the truth in `truth`.
ExchangeMatrix disturbed(const ExchangeMatrix& truth, std::size_t exact, unsigned seed) {
    ExchangeMatrix matrix = truth;
    std::mt19937 chance(seed);
    std::normal_distribution<double> normal;
    for (std::size_t k = 0; k < matrix.exchange.size(); ++k) {
        const double sigma = noise * static_cast<double>(truth.exchange[k]);
        matrix.ceiling[k] = 2.0f * truth.exchange[k];
        if (exact > 0 && k % exact == 0) continue;
        matrix.variance[k] = static_cast<float>(sigma * sigma);
        matrix.exchange[k] += static_cast<float>(sigma * normal(chance));
    }
    return matrix;
}

double distance2(const ExchangeMatrix& a, const ExchangeMatrix& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.exchange.size(); ++k)
        sum += std::pow(static_cast<double>(a.exchange[k] - b.exchange[k]), 2);
    return sum;
}

bool is_finite(const ExchangeMatrix& matrix) {
    for (const float h : matrix.exchange)
        if (!std::isfinite(h)) return false;
    for (std::size_t i = 0; i < matrix.size(); ++i)
        if (!std::isfinite(matrix.backs[i]) || !std::isfinite(matrix.escaped[i])) return false;
    return true;
}

TEST(RepairClosure, RestoresRowSumsAndGetsNearerToTheTruth) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
        const ExchangeMatrix truth = random_closed(60, 0.5, seed);
        ExchangeMatrix matrix = disturbed(truth, 0, seed);
        const double before = distance2(matrix, truth);
        repair_closure(matrix);
        EXPECT_LT(measure_closure(matrix).closure_max, closed);
        EXPECT_LT(distance2(matrix, truth), before);
    }
}

TEST(RepairClosure, LeavesExactEntriesAsTheyAre) {
    const ExchangeMatrix truth = random_closed(60, 0.5, 6);
    ExchangeMatrix matrix = disturbed(truth, 3, 6);
    const ExchangeMatrix before = matrix;
    repair_closure(matrix);
    EXPECT_LT(measure_closure(matrix).closure_max, closed);
    EXPECT_EQ(matrix.column, before.column);  // nothing is seen that was not
    for (std::size_t k = 0; k < matrix.exchange.size(); k += 3)
        EXPECT_EQ(matrix.exchange[k], before.exchange[k]);
}

TEST(RepairClosure, MakesTheMostLikelyChange) {
    // Least Σ (ΔH)² / v subject to closure, by the normal equations in double.
    const ExchangeMatrix truth = random_closed(12, 1.0, 7);
    ExchangeMatrix matrix = disturbed(truth, 0, 7);
    const ExchangeMatrix before = matrix;
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(12, 12);
    Eigen::VectorXd defect(12);
    for (PatchIndex i = 0; i < 12; ++i) defect[i] = matrix.area[i] * (1.0 - row_sum(matrix, i));
    for (PatchIndex i = 0; i < 12; ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            const PatchIndex j = matrix.column[k];
            const double v = static_cast<double>(matrix.variance[k]);
            system(i, i) += v, system(j, j) += v, system(i, j) += v, system(j, i) += v;
        }
    const Eigen::VectorXd multiplier = system.ldlt().solve(defect);
    repair_closure(matrix);
    for (PatchIndex i = 0; i < 12; ++i)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) {
            const double change = static_cast<double>(before.variance[k]) *
                                  (multiplier[i] + multiplier[matrix.column[k]]);
            EXPECT_NEAR(matrix.exchange[k], static_cast<double>(before.exchange[k]) + change, 1e-6);
        }
}

TEST(RepairClosure, KeepsWithinZeroAndTheCeiling) {
    const ExchangeMatrix truth = random_closed(40, 0.6, 8);
    ExchangeMatrix matrix = disturbed(truth, 0, 8);
    for (std::size_t k = 0; k < matrix.exchange.size(); ++k) {
        matrix.ceiling[k] = 1.02f * truth.exchange[k];  // many meet it
        matrix.exchange[k] = std::min(matrix.exchange[k], matrix.ceiling[k]);
        if (k % 7 == 0) matrix.exchange[k] = 0.0f;
    }
    repair_closure(matrix);
    for (std::size_t k = 0; k < matrix.exchange.size(); ++k) {
        EXPECT_GE(matrix.exchange[k], 0.0f);
        EXPECT_LE(matrix.exchange[k], matrix.ceiling[k]);
    }
    EXPECT_LT(measure_closure(matrix).closure_max, closed);
}

TEST(RepairClosure, MovesTheShareThatEscapesAsRaysKnewIt) {
    ExchangeMatrix matrix = empty_matrix({1.0, 1.0});
    add_entry(matrix, 0, 1, 0.5);  // exact
    finish(matrix);
    matrix.escaped = {0.40, 0.44};
    matrix.backs = {0.08, 0.0};
    matrix.escaped_variance = {3e-4, 1e-3};
    matrix.backs_variance = {1e-4, 0.0};
    repair_closure(matrix);
    EXPECT_NEAR(entry(matrix, 0, 1), 0.5, 1e-7);
    EXPECT_NEAR(matrix.escaped[0], 0.415, closed);  // 0.02 is missing: 3 to 1
    EXPECT_NEAR(matrix.backs[0], 0.085, closed);
    EXPECT_NEAR(matrix.escaped[1], 0.5, closed);
    EXPECT_EQ(matrix.backs[1], 0.0);
}

TEST(RepairClosure, LeavesAnExactMatrixAlone) {
    ExchangeMatrix matrix = random_closed(30, 0.5, 9);
    for (float& h : matrix.exchange) h *= 0.9f;  // a tenth is unaccounted for, and nothing may move
    const std::vector<float> before = matrix.exchange;
    repair_closure(matrix);
    EXPECT_EQ(matrix.exchange, before);
}

TEST(RepairClosure, AimsAtWhatIsLeftInAnOpenScene) {
    ExchangeMatrix matrix = disturbed(random_closed(30, 0.8, 10), 0, 10);
    for (std::size_t k = 0; k < matrix.exchange.size(); ++k) {
        matrix.exchange[k] *= 0.7f;
        matrix.variance[k] *= 0.49f;
    }
    matrix.escaped.assign(30, 0.3);
    repair_closure(matrix);
    for (PatchIndex i = 0; i < 30; ++i) EXPECT_NEAR(row_sum(matrix, i), 0.7, closed);
}

TEST(RepairClosure, ComesToAnEndWhereClosureCannotBeHad) {
    // Row 0 sees one patch alone, by half of what it would need.
    ExchangeMatrix matrix = empty_matrix({1.0, 1.0, 1.0});
    add_entry(matrix, 0, 1, 0.4, 1e-3, 0.5);
    add_entry(matrix, 1, 2, 0.4, 1e-3, 0.5);
    finish(matrix);
    repair_closure(matrix);
    EXPECT_TRUE(is_finite(matrix));
    EXPECT_LE(entry(matrix, 0, 1), 0.5);
    EXPECT_LE(entry(matrix, 1, 2), 0.5);
}

TEST(RepairClosure, ComesToAnEndOnPairsThatSeeOnlyEachOther) {
    // λ_0 + λ_1 alone is determined, and the two rows contradict each other.
    ExchangeMatrix matrix = empty_matrix({1.0, 2.0});
    add_entry(matrix, 0, 1, 0.9, 1e-3, 9.0);
    finish(matrix);
    repair_closure(matrix);
    EXPECT_TRUE(is_finite(matrix));
    EXPECT_GE(entry(matrix, 0, 1), 0.0);
    EXPECT_LE(entry(matrix, 0, 1), 9.0);
}

TEST(RepairClosure, ComesToAnEndOnVariancesOfAllSizes) {
    const ExchangeMatrix truth = random_closed(50, 0.3, 11);
    ExchangeMatrix matrix = disturbed(truth, 5, 11);
    std::mt19937 chance(11);
    for (float& v : matrix.variance)
        v *= std::pow(10.0f, -8.0f * static_cast<float>(uniform(chance)));
    const double before = measure_closure(matrix).closure_max;
    repair_closure(matrix);
    EXPECT_TRUE(is_finite(matrix));
    EXPECT_LE(measure_closure(matrix).closure_max, before);
}

}  // namespace
}  // namespace patchlight::repair_closure_test
