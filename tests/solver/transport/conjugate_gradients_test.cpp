#include "solver/transport/conjugate_gradients.h"

#include "solver/transport/residual.h"
#include "tests/solver/transport/problems.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::conjugate_gradients_test {
namespace {

constexpr double converged = 1e-10;  // relative to the largest radiosity

/// Steps from B = E until `most` steps are done or none helps; how many.
int run(const RadiosityProblem& problem, Field& radiosity, int most) {
    radiosity = problem.exitance;
    ConjugateGradients gradients(problem, measure_residual(problem, radiosity).residual);
    for (int step = 0; step < most; ++step)
        if (!gradients.step(radiosity)) return step;
    return most;
}

TEST(ConjugateGradients, ReachTheDirectSolution) {
    for (const double most : {0.5, 0.99, 0.9999}) {
        const auto owned = random_problem(120, 0.5, 1, most, 1);
        Field radiosity;
        run(owned->problem, radiosity, 120);
        EXPECT_LT(largest_difference(radiosity, solve_directly(owned->problem)), converged) << most;
    }
}

TEST(ConjugateGradients, NeedFewStepsWhereSweepsNeedThousands) {
    const auto owned = random_problem(120, 0.5, 1, 0.9999, 2);
    owned->problem.reflectance[0].assign(120, 0.9999);
    Field radiosity;
    run(owned->problem, radiosity, 25);
    EXPECT_LT(largest_difference(radiosity, solve_directly(owned->problem)), 1e-6);
}

TEST(ConjugateGradients, LeaveBlackPatchesAtTheirOwnLight) {
    const auto owned = random_problem(100, 0.5, 1, 0.95, 3);
    for (std::size_t i = 0; i < 100; i += 3) owned->problem.reflectance[0][i] = 0.0;
    Field radiosity;
    run(owned->problem, radiosity, 100);
    for (std::size_t i = 0; i < 100; i += 3)
        EXPECT_EQ(radiosity[0][i], owned->problem.exitance[0][i]) << i;
    EXPECT_LT(largest_difference(radiosity, solve_directly(owned->problem)), converged);
}

TEST(ConjugateGradients, SolveThreeChannelsAtOnce) {
    const auto owned = random_problem(100, 0.5, 3, 0.9, 4);
    for (std::size_t i = 0; i < 100; ++i) {
        owned->problem.reflectance[0][i] *= 0.2;
        owned->problem.reflectance[2][i] = i % 2 ? 0.0 : 0.999;
    }
    Field radiosity;
    run(owned->problem, radiosity, 100);
    EXPECT_LT(largest_difference(radiosity, solve_directly(owned->problem)), converged);
}

TEST(ConjugateGradients, SayWhenThereIsNothingToDo) {
    const auto owned = random_problem(50, 0.5, 3, 0.0, 5);  // nothing reflects
    Field radiosity;
    EXPECT_EQ(run(owned->problem, radiosity, 10), 0);
    EXPECT_EQ(radiosity, owned->problem.exitance);
}

TEST(ConjugateGradients, StayFinitePastConvergence) {
    const auto owned = random_problem(40, 0.5, 1, 0.9, 6);
    Field radiosity;
    run(owned->problem, radiosity, 400);
    EXPECT_LT(largest_difference(radiosity, solve_directly(owned->problem)), converged);
}

}  // namespace
}  // namespace patchlight::conjugate_gradients_test
