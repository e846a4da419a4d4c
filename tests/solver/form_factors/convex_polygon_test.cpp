#include "solver/form_factors/convex_polygon.h"

#include "solver/scene/polygon.h"
#include "tests/solver/form_factors/polygons.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace patchlight::convex_polygon_test {
namespace {

constexpr double rounding = 1e-13;

double area(const ConvexPolygon& polygon) {
    return polygon.size < 3 ? 0.0 : vector_area(polygon.view()).norm();
}

const ConvexPolygon square = convex(rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()));

TEST(ClipToFront, LeavesWhatIsInFront) {
    const ConvexPolygon kept = clip_to_front(square, Vec3(-1, 0, 0), Vec3::UnitX());
    EXPECT_EQ(kept.size, 4u);
    EXPECT_EQ(area(kept), 1.0);
}

TEST(ClipToFront, DropsWhatIsBehind) {
    EXPECT_EQ(clip_to_front(square, Vec3(2, 0, 0), Vec3::UnitX()).size, 0u);
}

TEST(ClipToFront, KeepsWhatLiesInThePlane) {
    EXPECT_EQ(clip_to_front(square, Vec3(5, 5, 0), Vec3::UnitZ()).size, 4u);
}

TEST(ClipToFront, CutsThroughCornersWithoutDoublingThem) {
    const ConvexPolygon half = clip_to_front(square, Vec3::Zero(), Vec3(1, -1, 0).normalized());
    EXPECT_EQ(half.size, 3u);
    EXPECT_NEAR(area(half), 0.5, rounding);
}

TEST(ClipToFront, BothSidesOfACutMakeTheWhole) {
    std::mt19937 chance(1);
    for (int n = 0; n < 500; ++n) {
        const Polygon facet = random_facet(chance);
        const Vec3 point = 0.7 * random_direction(chance), normal = random_direction(chance);
        const ConvexPolygon front = clip_to_front(convex(facet), point, normal),
                            back = clip_to_front(convex(facet), point, -normal);
        EXPECT_NEAR(area(front) + area(back), area(convex(facet)), rounding);
        for (const Vec3& p : front.view()) EXPECT_GT((p - point).dot(normal), -rounding);
    }
}

TEST(ClipToFront, HoldsAQuadCutByFourPlanes) {
    ConvexPolygon polygon = square;
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)}) {
        const Vec3 inwards = (Vec3(0.5, 0.5, 0) - corner).normalized();
        polygon = clip_to_front(polygon, corner + 0.1 * inwards, inwards);
    }
    EXPECT_EQ(polygon.size, 8u);
    EXPECT_NEAR(area(polygon), 1.0 - 4 * 0.01, rounding);
}

}  // namespace
}  // namespace patchlight::convex_polygon_test
