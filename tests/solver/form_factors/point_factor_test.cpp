#include "solver/form_factors/point_factor.h"

#include "tests/solver/form_factors/polygons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patchlight::point_factor_test {
namespace {

constexpr double rounding = 1e-12;

double factor(const Vec3& point, const Vec3& normal, const Polygon& polygon) {
    return point_factor(point, normal, convex(polygon), normal_of(polygon));
}

TEST(PointFactor, ParallelElementUnderACornerOfASquare) {
    EXPECT_NEAR(factor(Vec3::Zero(), Vec3::UnitZ(), {{0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}}),
                0.138531605994892997, rounding);
}

TEST(PointFactor, ParallelElementUnderTheCentreOfASquare) {
    EXPECT_NEAR(
        factor(Vec3::Zero(), Vec3::UnitZ(), {{-1, 1, 1}, {1, 1, 1}, {1, -1, 1}, {-1, -1, 1}}),
        0.554126423979571987, rounding);
}

TEST(PointFactor, ElementPerpendicularToARectangle) {
    EXPECT_NEAR(factor(Vec3(1, 0, 0), Vec3::UnitZ(), {{0, 0, 0}, {0, 1, 0}, {0, 1, 2}, {0, 0, 2}}),
                0.0950679411924033076, rounding);
}

TEST(PointFactor, WhatIsBelowTheHorizonDoesNotCount) {
    EXPECT_NEAR(
        factor(Vec3(1, 0, 0), Vec3::UnitZ(), {{0, 0, -3}, {0, 1, -3}, {0, 1, 2}, {0, 0, 2}}),
        0.0950679411924033076, rounding);
    EXPECT_EQ(
        factor(Vec3(1, 0, 0), Vec3::UnitZ(), {{0, 0, -3}, {0, 1, -3}, {0, 1, -1}, {0, 0, -1}}),
        0.0);
}

TEST(PointFactor, APlaneThatReachesTheHorizonAllRoundFillsTheHemisphere) {
    const double wide = 1e4;
    EXPECT_NEAR(factor(Vec3::Zero(), Vec3::UnitZ(),
                       {{-wide, wide, 1}, {wide, wide, 1}, {wide, -wide, 1}, {-wide, -wide, 1}}),
                1.0, 1e-8);  // 1 − F is of order 1 / wide²
}

TEST(PointFactor, ElementUnderADiskOf64Corners) {
    double sum = 0.0;
    for (const ConvexPolygon& part : fan(reversed(regular(64, 1.0, 1.0))))
        sum += point_factor(Vec3::Zero(), Vec3::UnitZ(), part, -Vec3::UnitZ());
    EXPECT_NEAR(sum, 0.499598211234437589, rounding);
}

TEST(PointFactor, TiltedElementAndObliqueTriangle) {
    const Vec3 normal(0.309426373877638, -0.20628424925175867, 0.928279121632914);
    EXPECT_NEAR(factor(Vec3::Zero(), normal, {{0.2, 0.6, 2.1}, {-0.7, 0.9, 0.5}, {1.2, -0.4, 0.3}}),
                0.125711158449812246, rounding);
}

TEST(PointFactor, FiveTriangularLightsOfARayTracersTests) {
    // scenes/pa5/tests of Nori (W. Jakob); factors are twice the radiance published there.
    const std::vector<std::pair<Polygon, double>> lights{{{{-0.443432, 0.596366, 0.495985},
                                                           {-0.320397, 0.0677699, -0.229359},
                                                           {0.0341197, 0.11415, -0.343049}},
                                                          0.179678517034780678},
                                                         {{{0.461963, 0.397843, 0.412747},
                                                           {-0.0381582, 0.851323, -0.156872},
                                                           {0.195443, 0.891957, -0.260672}},
                                                          0.045840080840021306},
                                                         {{{0.100871, 0.289075, -0.422609},
                                                           {-0.308386, 0.629587, 0.423966},
                                                           {-0.373132, 0.237287, 0.351592}},
                                                          0.106839080467932138},
                                                         {{{-0.17575, 0.639397, 0.151268},
                                                           {0.318604, 0.732996, 0.459771},
                                                           {0.139095, 0.294498, 0.478556}},
                                                          0.0410627829722780546},
                                                         {{{-0.17487, 0.447916, 0.367201},
                                                           {-0.405259, 0.249607, -0.354079},
                                                           {0.356029, 0.0918984, -0.132271}},
                                                          0.523479717782610232}};
    for (const auto& [light, exact] : lights) {
        const Polygon facing = normal_of(light).dot(light[0]) < 0.0 ? light : reversed(light);
        EXPECT_NEAR(factor(Vec3::Zero(), Vec3::UnitY(), facing), exact, rounding);
    }
}

TEST(PointFactor, IsZeroBehindAndInThePlaneOfThePolygon) {
    const Polygon square = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
    EXPECT_EQ(factor(Vec3(0.5, 0.5, -1), Vec3::UnitZ(), square), 0.0);
    EXPECT_EQ(factor(Vec3(3, 0.5, 0), -Vec3::UnitX(), square), 0.0);
    EXPECT_EQ(factor(Vec3(0.5, 0.5, 1), Vec3::UnitZ(), square), 0.0);  // faces away
}

TEST(PointFactor, IsTheKernelFarAway) {
    // Across the distance, 1000 sizes, beyond which Lambert's sum would cancel.
    const double finite_size = 1e-6;  // of a square seen 400 to 4000 sizes away: size² / distance²
    const Polygon square = rectangle(Vec3(-0.5, -0.5, 0), Vec3::UnitX(), Vec3::UnitY());
    for (const double distance : {800.0, 1300.0, 1500.0, 4000.0, 1e5, 1e8}) {
        const Vec3 point = distance * Vec3(0.6, 0, 0.8);
        const double kernel = 0.8 / (std::numbers::pi * distance * distance);
        EXPECT_NEAR(factor(point, -point.normalized(), square), kernel,
                    (finite_size + 1e-7) * kernel)
            << distance;
    }
}

}  // namespace
}  // namespace patchlight::point_factor_test
