#include "solver/transport/shooting.h"

#include "tests/solver/transport/row_engines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::shooting_test {
namespace {

constexpr double rounding = 1e-12;
constexpr double floats = 1e-6;  // rows are kept as floats

ShootingStop to(double tolerance, int max_shots = 1000000) {
    ShootingStop stop;
    stop.tolerance = tolerance;
    stop.max_shots = max_shots;
    return stop;
}

/// ‖Y(B − exact)‖ / ‖Y(exact − E)‖ in the norm Σ A |x|.
double relative_error(const ShootingProblem& problem, const Field& radiosity, const Field& exact) {
    double error = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < problem.size(); ++i) {
        double off = 0.0, reflected = 0.0;
        for (std::size_t c = 0; c < problem.channels(); ++c) {
            const double weight = luminance_weight(c, problem.channels());
            off += weight * (exact[c][i] - radiosity[c][i]);
            reflected += weight * (exact[c][i] - problem.exitance[c][i]);
        }
        error += problem.area[i] * std::abs(off);
        scale += problem.area[i] * std::abs(reflected);
    }
    return error / scale;
}

double power(const ShootingProblem& problem, const Field& field, std::size_t c) {
    double sum = 0.0;
    for (std::size_t i = 0; i < problem.size(); ++i) sum += problem.area[i] * field[c][i];
    return sum;
}

TEST(Shooting, ReachesTheSolutionOfItsRows) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto owned = random_shooting(random_rows(30, 0.5, seed), 3, 0.9, seed);
        const ShootingReport report = shoot(owned->problem, to(1e-10));
        EXPECT_EQ(report.stopped_by, StopReason::tolerance);
        EXPECT_LT(relative_error(owned->problem, report.state.radiosity, shot_directly(*owned)),
                  1e-9)
            << seed;
    }
}

TEST(Shooting, BoundsItsErrorAtEveryStepWhetherOrNotRowsAreReciprocal) {
    int bounds = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const double most = 0.5 + 0.49 * std::sqrt(seed / 40.0);
        const auto owned = random_shooting(random_rows(25, seed % 2 ? 1.0 : 0.3, seed),
                                           seed % 3 ? 1 : 3, most, seed);
        const Field exact = shot_directly(*owned);
        ShootingStop stop = to(1e-7);
        stop.observe = [&](const ShotSoFar& state) {
            if (!state.algebraic_bound) return StopReason::tolerance;
            ++bounds;
            const double error = relative_error(owned->problem, state.radiosity, exact);
            EXPECT_LE(error, *state.algebraic_bound + floats) << seed << ' ' << state.shots;
            return StopReason::tolerance;
        };
        shoot(owned->problem, stop);
    }
    EXPECT_GT(bounds, 500);
}

/// With one ρ in a closed scene the light to come is ρ / (1 − ρ) of the unshot light, no less.
TEST(Shooting, BoundIsTheErrorItselfInAClosedSceneOfOneReflectance) {
    OwnedShooting owned(alike(20), 1);
    owned.problem.exitance[0][3] = 1.0;
    const Field exact = shot_directly(owned);
    ShootingStop stop = to(1e-6);
    stop.observe = [&](const ShotSoFar& state) {
        if (state.algebraic_bound) {
            const double error = relative_error(owned.problem, state.radiosity, exact);
            // The bound refers to what is reflected at least, the error to what is reflected.
            EXPECT_NEAR(*state.algebraic_bound, error / (1.0 - 2.0 * error), 1e-3 * error + floats);
        }
        return StopReason::tolerance;
    };
    shoot(owned.problem, stop);
}

TEST(Shooting, IsALowerBoundThatOnlyGrows) {
    const auto owned = random_shooting(random_rows(25, 0.7, 3), 1, 0.9, 3);
    const Field exact = shot_directly(*owned);
    Field before = owned->problem.exitance;
    ShootingStop stop = to(1e-6);
    stop.observe = [&](const ShotSoFar& state) {
        for (std::size_t i = 0; i < 25; ++i) {
            EXPECT_GE(state.radiosity[0][i], before[0][i]);
            EXPECT_LE(state.radiosity[0][i], exact[0][i] * (1.0 + rounding));
        }
        before = state.radiosity;
        return StopReason::tolerance;
    };
    shoot(owned->problem, stop);
}

/// Emitted light is absorbed, lost outside, or not yet sent on.
TEST(Shooting, KeepsAllLightAtEveryShot) {
    const auto owned = random_shooting(random_rows(30, 0.4, 5), 3, 0.95, 5);
    const ShootingProblem& problem = owned->problem;
    ShootingStop stop = to(1e-8);
    stop.observe = [&](const ShotSoFar& state) {
        for (std::size_t c = 0; c < 3; ++c) {
            double absorbed = 0.0;
            for (std::size_t i = 0; i < problem.size(); ++i)
                absorbed +=
                    problem.area[i] * (1.0 - problem.reflectance[c][i]) * state.irradiance[c][i];
            const double emitted = power(problem, problem.exitance, c);
            EXPECT_NEAR(
                absorbed + state.lost[c][0] + state.lost[c][1] + power(problem, state.unshot, c),
                emitted, floats * emitted)
                << state.shots;
        }
        return StopReason::tolerance;
    };
    shoot(problem, stop);
}

TEST(Shooting, SendsTheBrightestFirst) {
    OwnedShooting owned(alike(10), 1);
    std::fill(owned.problem.reflectance[0].begin(), owned.problem.reflectance[0].end(), 0.01);
    owned.problem.exitance[0] = {0, 1, 0, 5, 0, 0, 2, 0, 0, 0};
    owned.problem.area = {1, 20, 1, 1, 1, 1, 1, 1, 1, 1};  // 20 W beside 5 and 2
    std::vector<Field> unshot;
    ShootingStop stop = to(1e-12, 3);
    stop.observe = [&](const ShotSoFar& state) {
        unshot.push_back(state.unshot);
        return StopReason::tolerance;
    };
    shoot(owned.problem, stop);
    ASSERT_GE(unshot.size(), 2u);
    EXPECT_LT(unshot[0][0][1], 0.1) << "by power, not by radiosity";
    EXPECT_GT(unshot[0][0][6], 1.9) << "below a quarter of the brightest: not together with it";
    EXPECT_LT(unshot.back()[0][3], 0.5);
}

/// Rows come up to eight at a time: whoever looks at each shot must not change what is shot.
TEST(Shooting, TellsOfEachShotAndTheResultStaysTheSame) {
    const auto owned = random_shooting(random_rows(30, 0.6, 9), 3, 0.9, 9),
               other = random_shooting(random_rows(30, 0.6, 9), 3, 0.9, 9);
    ShootingStop stop = to(1e-6);
    int told = 0;
    stop.observe = [&](const ShotSoFar& state) {
        EXPECT_EQ(state.shots, ++told);
        return StopReason::tolerance;
    };
    const ShootingReport watched = shoot(owned->problem, stop),
                         alone = shoot(other->problem, to(1e-6));
    EXPECT_EQ(told, watched.state.shots);
    EXPECT_EQ(watched.state.radiosity, alone.state.radiosity);
    EXPECT_EQ(watched.state.residual, alone.state.residual);
    EXPECT_EQ(watched.convergence.size(), alone.convergence.size());
}

TEST(Shooting, NeverMakesMoreShotsThanAllowed) {
    for (const int most : {0, 1, 5, 17}) {
        const auto owned = random_shooting(random_rows(30, 0.9, 7), 1, 0.9, 7);
        const ShootingReport report = shoot(owned->problem, to(1e-9, most));
        EXPECT_EQ(report.state.shots, most);
        EXPECT_EQ(report.stopped_by, StopReason::iteration_limit);
    }
}

TEST(Shooting, StopsWhenTheObserverSaysSo) {
    const auto owned = random_shooting(random_rows(30, 0.9, 8), 1, 0.9, 8);
    int calls = 0;
    ShootingStop stop = to(1e-9);
    stop.observe = [&](const ShotSoFar&) {
        return ++calls == 2 ? StopReason::cancelled : StopReason::tolerance;
    };
    const ShootingReport report = shoot(owned->problem, stop);
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(report.stopped_by, StopReason::cancelled);
    EXPECT_LE(report.state.shots, 16);
    EXPECT_GT(report.state.unshot_share, 0.0);
}

TEST(Shooting, OfADarkSceneIsDoneAtOnce) {
    OwnedShooting owned(alike(5), 3);
    const ShootingReport report = shoot(owned.problem, to(1e-4));
    EXPECT_EQ(report.stopped_by, StopReason::tolerance);
    EXPECT_EQ(report.state.shots, 0);
    EXPECT_EQ(owned.engine.asked(), 0);
}

TEST(Shooting, OfBlackSurfacesSendsLightOnce) {
    OwnedShooting owned(alike(6), 1);
    std::fill(owned.problem.reflectance[0].begin(), owned.problem.reflectance[0].end(), 0.0);
    owned.problem.exitance[0][2] = 3.0;
    const ShootingReport report = shoot(owned.problem, to(1e-4));
    EXPECT_EQ(report.stopped_by, StopReason::tolerance);
    EXPECT_EQ(report.state.shots, 1);
    EXPECT_EQ(report.state.algebraic_bound, 0.0);
    EXPECT_NEAR(report.state.irradiance[0][0], 0.6, floats);
    EXPECT_EQ(report.state.irradiance[0][2], 0.0);
}

TEST(Shooting, GivesTheSameBytesWhateverRowsAreKept) {
    std::vector<ShootingReport> reports;
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{2000}, std::size_t{1} << 30}) {
        const auto owned = random_shooting(random_rows(40, 0.9, 9), 3, 0.9, 9, bytes);
        reports.push_back(shoot(owned->problem, to(1e-6)));
        EXPECT_LE(owned->rows.bytes(), bytes);
    }
    for (const ShootingReport& report : reports) {
        EXPECT_EQ(report.state.radiosity, reports[0].state.radiosity);
        EXPECT_EQ(report.state.shots, reports[0].state.shots);
    }
}

TEST(Shooting, RecordsTheFirstShotsAndThenOnlyProgress) {
    const auto owned = random_shooting(random_rows(200, 1.0, 10), 1, 0.9, 10);
    const ShootingReport report = shoot(owned->problem, to(1e-6));
    const auto& steps = report.convergence;
    ASSERT_GT(steps.size(), 4u);
    EXPECT_LT(static_cast<int>(steps.size()), report.state.shots / 4);
    for (std::size_t k = 1; k < steps.size(); ++k) {
        EXPECT_GT(steps[k].iteration, steps[k - 1].iteration);
        EXPECT_LE(*steps[k].unshot, *steps[k - 1].unshot) << "no shot makes light";
        EXPECT_GE(steps[k].seconds, steps[k - 1].seconds);
        if (steps[k].iteration > 40) {
            EXPECT_LE(*steps[k].unshot, 0.95 * *steps[k - 1].unshot);
        }
    }
    EXPECT_LT(steps.back().residual, steps.front().residual);
}

}  // namespace
}  // namespace patchlight::shooting_test
