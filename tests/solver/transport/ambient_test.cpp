#include "solver/transport/ambient.h"

#include "tests/solver/transport/row_engines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::ambient_test {
namespace {

constexpr double rounding = 1e-12;
constexpr double floats = 1e-6;  // rows are kept as floats

std::vector<double> front_shares(const OwnedShooting& owned) {
    std::vector<double> shares;
    for (PatchIndex i = 0; i < owned.problem.size(); ++i)
        shares.push_back(1.0 - owned.engine.outside(i).escaped);
    return shares;
}

/// Area mean of B + ρ × ambient irradiance, what is shown.
double shown_mean(const OwnedShooting& owned, const ShotSoFar& state) {
    const ShootingProblem& problem = owned.problem;
    const std::vector<double> shares = front_shares(owned);
    const Field ambient =
        ambient_irradiance({problem.area, problem.reflectance, shares}, state.unshot);
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < problem.size(); ++i) {
        sum +=
            problem.area[i] * (state.radiosity[0][i] + problem.reflectance[0][i] * ambient[0][i]);
        area += problem.area[i];
    }
    return sum / area;
}

TEST(Ambient, KeepsTheAreaMeanOfAClosedUniformSceneAtEveryShot) {
    for (const double reflectance : {0.2, 0.8, 0.95}) {
        const auto owned = random_shooting(random_rows(30, 1.0, 4), 1, 0.9, 4);
        ShootingProblem& problem = owned->problem;
        std::fill(problem.reflectance[0].begin(), problem.reflectance[0].end(), reflectance);
        double emitted = 0.0, area = 0.0;
        for (std::size_t i = 0; i < problem.size(); ++i) {
            emitted += problem.area[i] * problem.exitance[0][i];
            area += problem.area[i];
        }
        const double exact = emitted / area / (1.0 - reflectance);
        ShotSoFar before;
        before.radiosity = before.unshot = problem.exitance;
        EXPECT_NEAR(shown_mean(*owned, before), exact, rounding * exact) << "before any shot";
        ShootingStop stop;
        stop.tolerance = 1e-6;
        stop.observe = [&](const ShotSoFar& state) {
            EXPECT_NEAR(shown_mean(*owned, state), exact, floats / (1 - reflectance) * exact);
            return StopReason::tolerance;
        };
        EXPECT_EQ(shoot(problem, stop).stopped_by, StopReason::tolerance);
    }
}

TEST(Ambient, GoesToNothingWithTheUnshotLight) {
    const auto owned = random_shooting(random_rows(30, 0.6, 5), 3, 0.9, 5);
    ShootingStop stop;
    stop.tolerance = 1e-9;
    const ShootingReport report = shoot(owned->problem, stop);
    const std::vector<double> shares = front_shares(*owned);
    const Field ambient = ambient_irradiance(
        {owned->problem.area, owned->problem.reflectance, shares}, report.state.unshot);
    for (const auto& channel : ambient)
        for (const double irradiance : channel) EXPECT_LT(irradiance, 1e-8);
}

TEST(Ambient, IsNothingWhereAPatchSeesNoFront) {
    const std::vector<double> area{1.0, 2.0, 3.0}, shares{0.0, 1.0, 0.5};
    const Field reflectance{{0.5, 0.5, 0.5}}, unshot{{7.0, 1.0, 2.0}};
    const Field ambient = ambient_irradiance({area, reflectance, shares}, unshot);
    // Seen 3.5 m², of which arrive 2 + 3 and return 0.5 (2 + 0.75).
    EXPECT_EQ(ambient[0][0], 0.0);
    EXPECT_NEAR(ambient[0][1], 5.0 / (3.5 - 1.375), rounding);
    EXPECT_NEAR(ambient[0][2], 0.5 * ambient[0][1], rounding);
}

TEST(Ambient, OfBlackOrLonelySurfacesIsFinite) {
    const std::vector<double> area{1.0, 1.0}, open{0.0, 0.0}, closed{1.0, 1.0};
    const Field black{{0.0, 0.0}}, unshot{{2.0, 4.0}};
    EXPECT_EQ(ambient_irradiance({area, black, closed}, unshot)[0][0], 3.0);
    EXPECT_EQ(ambient_irradiance({area, black, open}, unshot)[0][0], 0.0);
    const Field nearly_white{{0.999999, 0.999999}};
    EXPECT_TRUE(std::isfinite(ambient_irradiance({area, nearly_white, closed}, unshot)[0][0]));
}

TEST(Ambient, NeverBrightensAnOpenSceneMuchBeyondItsSolution) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const auto owned = random_shooting(random_rows(40, 0.3, seed), 1, 0.9, seed);
        ShotSoFar converged;
        converged.radiosity = shot_directly(*owned);
        converged.unshot.assign(1, std::vector<double>(40, 0.0));
        const double exact = shown_mean(*owned, converged);
        ShootingStop stop;
        stop.tolerance = 1e-6;
        stop.observe = [&](const ShotSoFar& state) {
            EXPECT_LT(shown_mean(*owned, state), 1.1 * exact) << seed << ' ' << state.shots;
            return StopReason::tolerance;
        };
        shoot(owned->problem, stop);
    }
}

}  // namespace
}  // namespace patchlight::ambient_test
