#include "solver/transport/gauss_seidel.h"

#include "solver/scene/input_error.h"
#include "tests/solver/form_factors/matrices.h"
#include "tests/solver/transport/problems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::gauss_seidel_test {
namespace {

constexpr double rounding = 1e-14;  // a sum of some hundred terms, relative

StopReason go_on(int, double) { return StopReason::tolerance; }

StopRule until(double tolerance, int most = 10000) { return {tolerance, most, go_on}; }

void sequential_sweep(const RadiosityProblem& problem, Field& radiosity) {
    for (PatchIndex i = 0; i < problem.size(); ++i)
        for (std::size_t c = 0; c < problem.channels(); ++c) {
            double sum = 0.0;
            for (PatchIndex j = 0; j < problem.size(); ++j)
                sum += problem.factors.at(i, j) * radiosity[c][j];
            radiosity[c][i] = problem.exitance[c][i] + problem.reflectance[c][i] * sum;
        }
}

class SweepOf : public testing::TestWithParam<std::tuple<double, std::size_t>> {};

TEST_P(SweepOf, IsThatOfASequentialSweep) {
    const auto [filled, channels] = GetParam();
    const auto owned = random_problem(301, filled, channels, 0.9, 1);  // blocks of 128 and a rest
    Field swept = owned->problem.exitance, expected = swept;
    for (int sweep = 0; sweep < 4; ++sweep) {
        gauss_seidel_sweep(owned->problem, swept);
        sequential_sweep(owned->problem, expected);
        EXPECT_LT(largest_difference(swept, expected), rounding) << sweep;
    }
}

INSTANTIATE_TEST_SUITE_P(GaussSeidel, SweepOf,
                         testing::Combine(testing::Values(1.0, 0.4, 0.05),
                                          testing::Values(std::size_t{1}, std::size_t{3})));

/// The sweep of many equal patches: e_k+1(x) = ρ (∫₀ˣ e_k+1 + ∫ₓ¹ e_k) has e_k+1 = μ e_k where
/// ln μ = ρ (1 − 1/μ), μ < 1.
double contraction_of_uniform_rows(double reflectance) {
    double low = 1e-9, high = 1.0 - 1e-9;  // μ = 1 is the other root
    if (reflectance > 0.5) low = reflectance * reflectance * 0.5;
    for (int step = 0; step < 200; ++step) {
        const double mu = 0.5 * (low + high);
        (std::log(mu) > reflectance * (1.0 - 1.0 / mu) ? low : high) = mu;
    }
    return 0.5 * (low + high);
}

class UniformRows : public testing::TestWithParam<double> {};

TEST_P(UniformRows, ContractAsIsKnown) {
    const double of_finitely_many = 0.01;  // 1500 patches stand for a continuum
    static const OwnedProblem owned(uniform_exchange(1500), 1);
    RadiosityProblem problem = owned.problem;
    problem.exitance[0].assign(problem.size(), 1.0);
    problem.reflectance[0].assign(problem.size(), GetParam());
    const double exact = 1.0 / (1.0 - GetParam() * problem.factors.row_sum(0));
    const auto error = [&](const Field& radiosity) {
        double sum = 0.0;
        for (const double b : radiosity[0]) sum += (b - exact) * (b - exact);
        return std::sqrt(sum);
    };
    Field radiosity = problem.exitance;
    double before = 0.0;
    for (int sweep = 0; sweep < 8; ++sweep) {
        before = error(radiosity);
        gauss_seidel_sweep(problem, radiosity);
    }
    const double known = contraction_of_uniform_rows(GetParam());
    EXPECT_NEAR(error(radiosity) / before, known, of_finitely_many * known);
}

INSTANTIATE_TEST_SUITE_P(GaussSeidel, UniformRows, testing::Values(0.5, 0.9, 0.99));

TEST(ContractionOfUniformRows, IsKnownToBe) {
    EXPECT_NEAR(contraction_of_uniform_rows(0.5), 0.285, 0.0005);
    EXPECT_NEAR(contraction_of_uniform_rows(0.9), 0.813, 0.0005);
    EXPECT_NEAR(contraction_of_uniform_rows(0.99), 0.980, 0.0005);
}

TEST(SolveGaussSeidel, MeetsTheDirectSolution) {
    for (const double most : {0.3, 0.9, 0.99, 0.9999})
        for (const std::size_t channels : {std::size_t{1}, std::size_t{3}}) {
            const auto owned = random_problem(150, 0.5, channels, most, 3);
            const SolveReport report = solve_gauss_seidel(owned->problem, until(1e-9));
            EXPECT_EQ(report.stopped_by, StopReason::tolerance);
            EXPECT_LE(
                relative_error(owned->problem, report.radiosity, solve_directly(owned->problem)),
                1e-9)
                << most;
        }
}

TEST(SolveGaussSeidel, TakesConjugateGradientsWhereSweepsCrawl) {
    const auto dim = random_problem(150, 0.5, 1, 0.5, 4),
               bright = random_problem(150, 0.5, 1, 0.999, 4);
    std::fill(bright->problem.reflectance[0].begin(), bright->problem.reflectance[0].end(), 0.999);
    EXPECT_FALSE(solve_gauss_seidel(dim->problem, until(1e-4)).used_conjugate_gradients);
    const SolveReport report = solve_gauss_seidel(bright->problem, until(1e-6));
    EXPECT_TRUE(report.used_conjugate_gradients);
    EXPECT_LT(report.convergence.size(), 100u);  // sweeps alone would take some ten thousand
    EXPECT_LE(relative_error(bright->problem, report.radiosity, solve_directly(bright->problem)),
              1e-6);
}

TEST(SolveGaussSeidel, DoesNotTrustTheChangeBetweenSweeps) {
    const double tolerance = 1e-3;
    OwnedProblem owned(uniform_exchange(200), 1);
    owned.problem.exitance[0].assign(200, 1.0);
    owned.problem.reflectance[0].assign(200, 0.99);
    const Field exact = solve_directly(owned.problem);
    Field radiosity = owned.problem.exitance, before;
    do {
        before = radiosity;
        gauss_seidel_sweep(owned.problem, radiosity);
    } while (largest_difference(before, radiosity) > tolerance);
    EXPECT_GT(relative_error(owned.problem, radiosity, exact), 20 * tolerance);  // it would lie
    const SolveReport report = solve_gauss_seidel(owned.problem, until(tolerance));
    EXPECT_LE(relative_error(owned.problem, report.radiosity, exact), tolerance);
}

TEST(SolveGaussSeidel, RefusesLightThatNeverDiesOut) {
    for (const double reflectance : {1.0, 1.01}) {
        const auto owned = random_problem(20, 1.0, 1, 0.5, 1);
        owned->problem.reflectance[0].assign(20, reflectance);
        try {
            solve_gauss_seidel(owned->problem, until(1e-4));
            FAIL() << "not refused";
        } catch (const InputError& error) {
            EXPECT_EQ(error.pointer(), "/materials");
        }
    }
}

TEST(SolveGaussSeidel, AnswersInTheSameProportionHoweverBrightTheLight) {
    const auto owned = random_problem(100, 0.5, 1, 0.9, 5);
    const SolveReport unit = solve_gauss_seidel(owned->problem, until(1e-6));
    for (const double brightness : {1e-9, 1e9}) {
        for (double& e : owned->problem.exitance[0]) e *= brightness;
        const SolveReport scaled = solve_gauss_seidel(owned->problem, until(1e-6));
        EXPECT_EQ(scaled.convergence.size(), unit.convergence.size());
        for (std::size_t i = 0; i < 100; ++i)
            EXPECT_NEAR(scaled.radiosity[0][i] / brightness, unit.radiosity[0][i],
                        1e-12 * unit.radiosity[0][i]);
        for (double& e : owned->problem.exitance[0]) e /= brightness;
    }
}

TEST(SolveGaussSeidel, ADarkSceneIsDark) {
    const auto owned = random_problem(30, 0.5, 3, 0.9, 6);
    for (auto& channel : owned->problem.exitance) std::fill(channel.begin(), channel.end(), 0.0);
    const SolveReport report = solve_gauss_seidel(owned->problem, until(1e-4));
    EXPECT_EQ(report.stopped_by, StopReason::tolerance);
    EXPECT_EQ(report.radiosity, owned->problem.exitance);
}

TEST(SolveGaussSeidel, ABlackRoomShowsItsLightsAlone) {
    const auto owned = random_problem(30, 0.5, 1, 0.0, 6);
    const SolveReport report = solve_gauss_seidel(owned->problem, until(1e-4));
    EXPECT_EQ(report.stopped_by, StopReason::tolerance);
    EXPECT_EQ(report.radiosity, owned->problem.exitance);
}

TEST(SolveGaussSeidel, OneDarkChannelDoesNotHoldUpTheOthers) {
    const auto owned = random_problem(60, 0.5, 3, 0.99, 7);
    std::fill(owned->problem.exitance[1].begin(), owned->problem.exitance[1].end(), 0.0);
    const SolveReport report = solve_gauss_seidel(owned->problem, until(1e-8));
    EXPECT_EQ(report.stopped_by, StopReason::tolerance);
    EXPECT_LT(largest_difference(report.radiosity, solve_directly(owned->problem)), 1e-7);
}

TEST(SolveGaussSeidel, StopsAtTheIterationLimit) {
    const auto owned = random_problem(60, 0.5, 1, 0.99, 8);
    for (const int most : {1, 3, 7}) {
        const SolveReport report = solve_gauss_seidel(owned->problem, until(1e-12, most));
        EXPECT_EQ(report.stopped_by, StopReason::iteration_limit);
        EXPECT_EQ(std::ssize(report.convergence), most);
        EXPECT_EQ(report.convergence.back().iteration, most);
    }
}

TEST(SolveGaussSeidel, ClaimsNothingWithoutAnIteration) {
    const auto owned = random_problem(60, 0.5, 1, 0.9, 8);
    EXPECT_EQ(solve_gauss_seidel(owned->problem, until(1e-4, 0)).stopped_by,
              StopReason::iteration_limit);
}

TEST(SolveGaussSeidel, StopsWhenTold) {
    const auto owned = random_problem(60, 0.5, 1, 0.99, 9);
    for (const StopReason told : {StopReason::cancelled, StopReason::time_limit}) {
        const SolveReport report = solve_gauss_seidel(
            owned->problem, {1e-12, 1000, [&](int iteration, double residual) {
                                 EXPECT_GT(residual, 0.0);
                                 return iteration == 6 ? told : StopReason::tolerance;
                             }});
        EXPECT_EQ(report.stopped_by, told);
        EXPECT_EQ(report.convergence.size(), 6u);
    }
}

}  // namespace
}  // namespace patchlight::gauss_seidel_test
