#include "solver/accuracy/field_difference.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::field_difference_test {
namespace {

constexpr double rounding = 1e-12;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// One patch and two triangles a rectangle; corners are not shared.
Solution plates(const Scene& scene) {
    Solution solution;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        Patch patch;
        patch.surface = s;
        solution.mesh.patches.push_back(patch);
        const auto first = static_cast<std::uint32_t>(solution.display.positions.size());
        for (const Vec3& corner : scene.surfaces[s].corners)
            solution.display.positions.push_back(corner);
        solution.display.triangles.push_back({first, first + 1, first + 2});
        solution.display.triangles.push_back({first, first + 2, first + 3});
        solution.display.patch.insert(solution.display.patch.end(), 2, s);
    }
    solution.display.radiosity.assign(solution.display.positions.size(), Rgb::Zero());
    return solution;
}

TEST(SpreadPoints, EqualAreasGetEqualNumbersOfPoints) {
    const Scene scene = scene_of({rectangle(Vec3::Zero(), x, y), rectangle(5.0 * z, x, 2.0 * y)});
    constexpr std::size_t count = 3000;
    const std::vector<ComparedPoint> points = spread_points(plates(scene), count);
    ASSERT_EQ(points.size(), count);
    std::size_t on_small = 0, on_lower_half = 0;
    for (const ComparedPoint& point : points) {
        if (point.surface == 0) ++on_small;
        if (point.surface == 1 && point.position.y() < 1.0) ++on_lower_half;
        EXPECT_NEAR(point.position.z(), point.surface == 0 ? 0.0 : 5.0, rounding);
    }
    EXPECT_NEAR(static_cast<double>(on_small), 1000.0, 1.0);        // strata cut by the border: one
    EXPECT_NEAR(static_cast<double>(on_lower_half), 1000.0, 20.0);  // far below 3 sigma of chance
}

TEST(SpreadPoints, NothingDisplayedHasNoPoints) {
    EXPECT_TRUE(spread_points(Solution{}, 16).empty());
}

TEST(RelativeDifference, AnOffsetIsMeasuredExactly) {
    const Scene scene = scene_of({rectangle(Vec3::Zero(), x, y), rectangle(z, y, x)});
    Solution right = plates(scene), wrong = right;
    for (std::size_t v = 0; v < right.display.positions.size(); ++v) {
        right.display.radiosity[v] = Rgb(2.0, 2.0, 2.0);
        wrong.display.radiosity[v] = Rgb(2.1, 2.1, 2.1);
    }
    const auto points = spread_points(right, 512);
    const auto a = reflected_at(scene, DisplayedField(scene, wrong), points),
               b = reflected_at(scene, DisplayedField(scene, right), points);
    ASSERT_TRUE(relative_difference(a, b));
    EXPECT_NEAR(*relative_difference(a, b), 0.05, rounding);
    EXPECT_EQ(relative_difference(b, b), 0.0);
}

TEST(RelativeDifference, WhatIsGivenOffIsNoLightToErrAbout) {
    Scene scene = empty_scene();
    scene.materials[lamp].reflectance = Rgb::Constant(0.5);
    add(scene, rectangle(Vec3::Zero(), x, y), lamp);  // exitance 1
    Solution right = plates(scene), wrong = right;
    for (Rgb& radiosity : right.display.radiosity) radiosity = Rgb::Constant(1.5);
    for (Rgb& radiosity : wrong.display.radiosity) radiosity = Rgb::Constant(1.4);
    const auto points = spread_points(right, 64);
    const auto a = reflected_at(scene, DisplayedField(scene, wrong), points),
               b = reflected_at(scene, DisplayedField(scene, right), points);
    EXPECT_NEAR(*relative_difference(a, b), 0.1 / 0.5, rounding);
}

TEST(RelativeDifference, ASlopeIsIntegratedOverTheArea) {
    constexpr double spread = 2e-4;  // of 4096 low-discrepancy points, about 1/n
    const Scene scene = scene_of(rectangle(Vec3::Zero(), x, y));
    Solution right = plates(scene), sloping = right;
    for (std::size_t v = 0; v < 4; ++v) {
        right.display.radiosity[v] = Rgb::Constant(1.0);
        sloping.display.radiosity[v] = Rgb::Constant(1.0 + right.display.positions[v].x());
    }
    const auto points = spread_points(right, 4096);
    const auto a = reflected_at(scene, DisplayedField(scene, sloping), points),
               b = reflected_at(scene, DisplayedField(scene, right), points);
    EXPECT_NEAR(*relative_difference(a, b), std::sqrt(1.0 / 3.0), spread);  // √∫ x² dx
}

TEST(RelativeDifference, WithoutLightThereIsNone) {
    const std::vector<double> dark(4, 0.0), lit(4, 1.0);
    EXPECT_FALSE(relative_difference(lit, dark));
}

TEST(RelativeDifference, AtSensorsTheWorstCountsRelativeToTheBrightest) {
    const std::vector<SensorReport> right{{Rgb::Constant(10.0), 0.0}, {Rgb::Constant(2.0), 0.0}},
        wrong{{Rgb::Constant(10.1), 0.0}, {Rgb::Constant(1.5), 0.0}};
    EXPECT_NEAR(*relative_difference(wrong, right), 0.05, rounding);
    EXPECT_FALSE(relative_difference(std::span(wrong).first(1), right));
    EXPECT_FALSE(relative_difference(std::span(wrong).first(0), std::span(right).first(0)));
}

}  // namespace
}  // namespace patchlight::field_difference_test
