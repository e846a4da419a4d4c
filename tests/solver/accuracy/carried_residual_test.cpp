#include "solver/accuracy/carried_residual.h"

#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patchlight::carried_residual_test {
namespace {

constexpr double missed = 3.0;  // at each point in question [W/m²]

/// Points all over a scene of one reflectance, so many on each surface, in the middle of equal
/// parts; at those of the first `wrong` surfaces light is missing.
CheckReport report_of(const EngineScene& of, double reflectance, int n, SurfaceIndex wrong) {
    CheckReport report;
    const Scene& scene = of.cut.scene;
    const double count = static_cast<double>(scene.surfaces.size()) * n * n;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        for (int k = 0; k < n * n; ++k) {
            const double u = (k % n + 0.5) / n, v = (k / n + 0.5) / n;
            ResidualPoint point;
            point.place.position = surface.corners[0] +
                                   u * (surface.corners[1] - surface.corners[0]) +
                                   v * (surface.corners[3] - surface.corners[0]);
            point.place.normal = surface.normal;
            point.place.frame = of.rays.frame(s);
            point.place.origin = of.rays.to_ray_space(point.place.position) +
                                 of.rays.lift(s) * surface.normal.cast<float>();
            point.object = surface.object;
            point.density = n * n / surface.area / count;
            point.reflectance = Rgb::Constant(reflectance);
            point.light = Rgb::Ones();
            if (s < wrong) point.missing.fill(Rgb::Constant(missed));
            report.indirect_points.push_back(point);
        }
    }
    return report;
}

/// √∫ Y² dA, the mean and no doubt on top.
double carried(const EngineScene& of, const CheckReport& report, const EnergyReport& energy) {
    return carried_residual(of.cut.scene, of.rays, report, energy, 1).at_most(0.0);
}

/// So unsure that it says nothing.
EnergyReport unknown_energy() {
    EnergyReport energy;
    energy.emitted = Rgb::Ones();
    energy.standard_error = 1e6;
    return energy;
}

TEST(CarriedResidual, GoesToAndFroBetweenFacingPlates) {
    // Hottel's factor of squares at a tenth of their width. What goes to and fro longest is in the
    // middle, where it is larger.
    constexpr double factor = 0.827, reflectance = 0.9;
    const EngineScene plates(scene_of({rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()),
                                       rectangle(Vec3(0, 0, 0.1), Vec3::UnitY(), Vec3::UnitX())}),
                             1.0);
    const double expected = reflectance * missed / (1.0 - reflectance * factor) * std::sqrt(2.0);
    const double both = carried(plates, report_of(plates, reflectance, 10, 2), unknown_energy());
    EXPECT_GT(both, 1.02 * expected);
    EXPECT_LT(both, 1.2 * expected);
}

TEST(CarriedResidual, WhatIsMissingEverywhereIsWhatTheEnergySays) {
    constexpr double reflectance = 0.8;
    const EngineScene closed(room(), 1.0);
    const CheckReport report = report_of(closed, reflectance, 7, 6);
    EnergyReport energy;
    energy.emitted = Rgb::Constant(100.0);
    energy.absorbed = Rgb::Constant(100.0 - 6.0 * missed);
    // Of 6 m² in a closed room: what is missing once is absorbed sooner or later.
    EXPECT_NEAR(carried(closed, report, energy),
                reflectance * missed / (1.0 - reflectance) * std::sqrt(6.0),
                0.02 * missed / (1.0 - reflectance) * std::sqrt(6.0));
    energy.absorbed = energy.emitted;
    EXPECT_NEAR(carried(closed, report, energy), 0.0, 0.1 * missed);
}

TEST(CarriedResidual, TheNoiseOfTheEnergyIsADoubtAboutAll) {
    constexpr double reflectance = 0.8, doubt = 0.02;
    const EngineScene closed(room(), 1.0);
    CheckReport report = report_of(closed, reflectance, 7, 0);
    std::mt19937 chance(2);
    for (ResidualPoint& point : report.indirect_points)  // far too noisy to tell
        for (Rgb& half : point.missing) half = Rgb::Constant(20.0 * (uniform(chance) - 0.5));
    EnergyReport energy;
    energy.emitted = energy.absorbed = Rgb::Constant(6.0 * (1.0 - reflectance));  // light is 1
    const double sure = carried_residual(closed.cut.scene, closed.rays, report, energy, 1).square;
    energy.standard_error = doubt;
    const double unsure = carried_residual(closed.cut.scene, closed.rays, report, energy, 1).square;
    EXPECT_NEAR((unsure - sure) / std::pow(reflectance * doubt * std::sqrt(6.0), 2), 1.0, 0.2);
}

TEST(CarriedResidual, IsTheResidualWhereNothingIsSentOn) {
    const EngineScene plate(scene_of(rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY())), 1.0);
    EXPECT_NEAR(carried(plate, report_of(plate, 0.5, 5, 1), unknown_energy()), 0.5 * missed, 1e-9);
    EXPECT_EQ(carried(plate, report_of(plate, 0.5, 5, 0), unknown_energy()), 0.0);
}

TEST(CarriedResidual, NoiseOfTheHalvesIsInNeitherMean) {
    const EngineScene closed(room(), 1.0);
    CheckReport report = report_of(closed, 0.5, 10, 0);
    std::mt19937 chance(1);
    double square = 0.0;
    for (ResidualPoint& point : report.indirect_points)
        for (Rgb& half : point.missing) {
            half = Rgb::Constant(uniform(chance) - 0.5);
            square += 0.5 * 0.25 * half[0] * half[0] / point.density / 600.0;
        }
    const MeasuredError error =
        carried_residual(closed.cut.scene, closed.rays, report, unknown_energy(), 1);
    EXPECT_LT(std::abs(error.square), 4.0 * std::sqrt(error.variance));  // 1 in 15,000
    EXPECT_LT(std::abs(error.square), 0.2 * square);
}

}  // namespace
}  // namespace patchlight::carried_residual_test
