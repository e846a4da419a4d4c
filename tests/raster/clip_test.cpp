#include "raster/clip.h"

#include <gtest/gtest.h>
#include <random>

namespace patchlight::raster::clip_test {
namespace {

using Eigen::Array3d;
using Eigen::Vector4d;

constexpr double rounding = 1e-12;  // double arithmetic on numbers of order 1

ClipVertex vertex(double x, double y, double z, double w) {
    return {{x, y, z, w}, {x, y, w}};  // colour is linear in position, so it can be checked
}

ClipVertex random_vertex(std::mt19937& chance) {
    std::uniform_real_distribution<double> spread(-2.0, 2.0);
    return vertex(spread(chance), spread(chance), spread(chance), spread(chance));
}

/// Area after the division by w.
double area_of(const ClipPolygon& polygon) {
    double twice = 0.0;
    for (int i = 0; i < polygon.size; ++i) {
        const Vector4d& p = polygon.corners[static_cast<std::size_t>(i)].position;
        const Vector4d& q =
            polygon.corners[static_cast<std::size_t>((i + 1) % polygon.size)].position;
        twice += (p.x() * q.y() - q.x() * p.y()) / (p.w() * q.w());
    }
    return 0.5 * twice;
}

TEST(Clip, LeavesATriangleInsideAsItIs) {
    const ClipPolygon polygon =
        clip(vertex(0, 0, 0.5, 1), vertex(1, 0, 0.5, 1), vertex(0, 1, 0.5, 1));
    ASSERT_EQ(polygon.size, 3);
    EXPECT_EQ(polygon.corners[1].position, Vector4d(1, 0, 0.5, 1));
}

TEST(Clip, DropsATriangleOutsideOfOnePlane) {
    EXPECT_EQ(clip(vertex(2, 0, 0.5, 1), vertex(3, 0, 0.5, 1), vertex(2, 1, 0.5, 1)).size, 0);
    EXPECT_EQ(clip(vertex(0, 0, 2, 1), vertex(1, 0, 2, 1), vertex(0, 1, 2, 1)).size, 0);
    EXPECT_EQ(clip(vertex(0, 0, 1, -1), vertex(1, 0, 1, -1), vertex(0, 1, 1, -1)).size, 0);
}

TEST(Clip, DropsATrianglePastACornerThatNoSinglePlaneExcludes) {
    EXPECT_EQ(clip(vertex(3, 0, 0.5, 1), vertex(3, 3, 0.5, 1), vertex(0, 3, 0.5, 1)).size, 0);
}

TEST(Clip, ATriangleAroundTheVolumeBecomesItsCrossSection) {
    const ClipPolygon polygon =
        clip(vertex(-9, -9, 0.5, 1), vertex(9, -9, 0.5, 1), vertex(0, 18, 0.5, 1));
    EXPECT_EQ(polygon.size, 4);
    EXPECT_NEAR(area_of(polygon), 4.0, rounding);
}

TEST(Clip, EveryCornerIsInsideAndItsColourFollowsItsPlace) {
    std::mt19937 chance(1);
    for (int trial = 0; trial < 20000; ++trial) {
        const ClipPolygon polygon =
            clip(random_vertex(chance), random_vertex(chance), random_vertex(chance));
        for (int i = 0; i < polygon.size; ++i) {
            const ClipVertex& corner = polygon.corners[static_cast<std::size_t>(i)];
            const Vector4d& p = corner.position;
            EXPECT_GE(p.w() + rounding, std::abs(p.x()));
            EXPECT_GE(p.w() + rounding, std::abs(p.y()));
            EXPECT_GE(p.w() + rounding, p.z());
            EXPECT_GE(p.z(), -rounding);
            EXPECT_TRUE((corner.colour - Array3d(p.x(), p.y(), p.w()) < rounding).all());
        }
    }
}

TEST(Clip, NeighboursGetTheSameCornersOnTheirCommonEdge) {
    std::mt19937 chance(2);
    const auto has = [](const ClipPolygon& polygon, const Vector4d& position) {
        for (int i = 0; i < polygon.size; ++i)
            if (polygon.corners[static_cast<std::size_t>(i)].position == position) return true;
        return false;
    };
    for (int trial = 0; trial < 20000; ++trial) {
        const ClipVertex a = random_vertex(chance);
        const ClipVertex b = random_vertex(chance);
        // What is left of the edge alone: the triangle that goes there and back.
        const ClipPolygon edge = clip(a, b, b);
        const ClipPolygon one_side = clip(a, b, random_vertex(chance));
        const ClipPolygon other_side = clip(b, a, random_vertex(chance));
        for (int i = 0; i < edge.size; ++i) {
            const Vector4d& corner = edge.corners[static_cast<std::size_t>(i)].position;
            EXPECT_TRUE(has(one_side, corner));
            EXPECT_TRUE(has(other_side, corner));
        }
    }
}

}  // namespace
}  // namespace patchlight::raster::clip_test
