#include "solver/scene/polygon.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace patchlight::frame_along_test {
namespace {

TEST(FrameAlong, TurnsWithThePolygon) {
    const Polygon polygon = l_shape();
    const Motion motion{2.5, Vec3(3, -1, 7), odd_turn()};
    const PlaneFrame here = frame_along(polygon, Vec3::UnitZ()),
                     there = frame_along(moved(polygon, motion), motion.turn * Vec3::UnitZ());
    for (const Vec3& p : polygon)
        EXPECT_LT((2.5 * here.flat(p) - there.flat(motion(p))).norm(), 1e-12);
    EXPECT_LT((there.u.cross(there.v) - there.normal).norm(), 1e-15);
}

TEST(FrameAlong, NeedsNoEdgeInThePlane) {
    const PlaneFrame frame = frame_along(Vec3::Zero(), 2.0 * Vec3::UnitZ(), Vec3::UnitZ());
    EXPECT_LT((frame.u.cross(frame.v) - frame.normal).norm(), 1e-15);
}

TEST(ConvexHull, HasNoCornersAlongItsEdges) {
    const PlaneFrame frame = frame_of(Vec3::Zero(), Vec3::UnitZ());
    Polygon points;
    for (int k = 0; k <= 8; ++k)
        for (const double y : {0.0, 1.0})
            points.push_back({k / 8.0, y + (k % 2 ? 1e-16 : 0.0), 0.0});
    EXPECT_EQ(convex_hull(points, frame).size(), 4u);
}

}  // namespace
}  // namespace patchlight::frame_along_test
