#include "solver/form_factors/patch_points.h"

#include "tests/solver/form_factors/polygons.h"

#include <gtest/gtest.h>

#include <numbers>

namespace patchlight::patch_points_test {
namespace {

constexpr double rounding = 1e-13;

class PointsOfOrder : public testing::TestWithParam<int> {};

TEST_P(PointsOfOrder, WeighThePatchAndBalanceAtItsCentre) {
    const CutScene plate =
        cut(scene_of({l_shape(), flat({{5, 0}, {6.4, 0.1}, {6, 1}, {5.1, 0.7}}), regular(5, 0.4)}),
            0.4);
    const int order = GetParam();
    const PatchPoints points = make_patch_points(plate.mesh, order);
    ASSERT_EQ(points.per_patch, static_cast<std::size_t>(order * order));
    for (PatchIndex i = 0; i < plate.mesh.size(); ++i) {
        if (plate.mesh.patches[i].covered) continue;  // stands for an area that is not meshed
        double area = 0.0;
        Vec3 moment = Vec3::Zero();
        for (std::size_t k = i * points.per_patch; k < (i + 1) * points.per_patch; ++k) {
            area += points.weight[k];
            moment += points.weight[k] * Vec3(points.x[k], points.y[k], points.z[k]);
        }
        EXPECT_NEAR(area, plate.mesh.patches[i].area, rounding);
        EXPECT_LT((moment / area - plate.mesh.patches[i].centre).norm(), rounding * 10);
    }
}

INSTANTIATE_TEST_SUITE_P(PatchPoints, PointsOfOrder, testing::Values(2, 3, 4));

TEST(KernelExchange, OfFarPatchesIsTheKernelTimesBothAreas) {
    const double distance = 1000.0, finite_size = 1e-5;  // size² / distance², ten-fold
    const Polygon lower = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()),
                  upper = rectangle(Vec3(0, 0, distance), Vec3::UnitY(), Vec3::UnitX());
    const double exact = 1.0 / (std::numbers::pi * distance * distance);
    const CutScene both = cut(scene_of({lower, upper}), 9.0);
    for (const int order : {2, 3, 4}) {
        const PatchPoints points = make_patch_points(both.mesh, order);
        EXPECT_NEAR(kernel_exchange(points, 0, Vec3::UnitZ(), 1, -Vec3::UnitZ()), exact,
                    finite_size * exact);
    }
    EXPECT_NEAR(kernel_exchange(convex(lower), Vec3::UnitZ(), convex(upper), -Vec3::UnitZ()), exact,
                finite_size * exact);
}

TEST(KernelExchange, OfPolygonsAgreesWithThatOfPatches) {
    const Polygon lower = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()),
                  upper = rectangle(Vec3(3, 2, 9), Vec3::UnitY(), Vec3::UnitX());
    const CutScene both = cut(scene_of({lower, upper}), 9.0);
    const double expected =
        kernel_exchange(make_patch_points(both.mesh, 3), 0, Vec3::UnitZ(), 1, -Vec3::UnitZ());
    EXPECT_NEAR(kernel_exchange(convex(lower), Vec3::UnitZ(), convex(upper), -Vec3::UnitZ()),
                expected, rounding * expected * 100);
}

TEST(KernelExchange, OfPolygonsOfAllSizesMeetsItsParts) {
    for (int corners = 3; corners <= 8; ++corners) {  // whole vectors of points, and parts of them
        const Polygon disk = regular(corners, 1.0), far = reversed(regular(corners, 1.0, 40.0));
        double sum = 0.0;
        for (std::size_t k = 1; k + 1 < disk.size(); ++k)
            sum += kernel_exchange(convex({disk[0], disk[k], disk[k + 1]}), Vec3::UnitZ(),
                                   convex(far), -Vec3::UnitZ());
        EXPECT_NEAR(kernel_exchange(convex(disk), Vec3::UnitZ(), convex(far), -Vec3::UnitZ()), sum,
                    1e-8 * sum)
            << corners;
    }
}

}  // namespace
}  // namespace patchlight::patch_points_test
