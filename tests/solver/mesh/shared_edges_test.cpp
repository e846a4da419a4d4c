#include "solver/mesh/make_patches.h"

#include "tests/solver/mesh/mesh_checks.h"

#include <gtest/gtest.h>

namespace patchlight::shared_edges_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

TEST(SharedEdges, WallsOfARoomShareTheirVertices) {
    EXPECT_EQ(edges_not_shared(cut(room(), 0.13)), "");
    EXPECT_EQ(edges_not_shared(cut(moved(room(), {1.0, Vec3(5, 3, 1), odd_turn()}), 0.13)), "");
}

TEST(SharedEdges, AGridAndAGeneralPolygonShareTheirs) {
    const Polygon wall = rectangle(Vec3::Zero(), z, 2 * x);  // stands on the long edge of the L
    EXPECT_EQ(edges_not_shared(cut(scene_of({l_shape(), wall}), 0.17)), "");
}

TEST(SharedEdges, AFinelyCutNeighbourPassesItsPartsOn) {
    // The strip is cut across for its shape; the squares on either side of it follow.
    const Scene scene = scene_of({rectangle(Vec3(0, 0, 0), x, y), rectangle(y, x, 0.02 * y),
                                  rectangle(Vec3(0, 1.02, 0), x, y)});
    EXPECT_EQ(edges_not_shared(cut(scene, 1.0)), "");
}

TEST(SharedEdges, BothSidesOfATwoSidedPolygonShareTheirOutline) {
    Scene scene = empty_scene();
    add(scene, l_shape(), two_sided);
    EXPECT_EQ(edges_not_shared(cut(scene, 0.2)), "");
}

TEST(SharedEdges, TrianglesOfACutQuadShareTheDiagonal) {
    Polygon warped = rectangle(Vec3::Zero(), x, y);
    warped[2].z() = 0.2;
    EXPECT_EQ(edges_not_shared(cut(scene_of(warped), 0.15)), "");
}

TEST(SharedEdges, StayWholeWhereACreaseEndsOnThem) {
    // A partition stands across the seam of two floors.
    const Scene scene = scene_of(
        {rectangle(Vec3(0, 0, 0), x, y), rectangle(x, x, y), rectangle(Vec3(0.5, 0.43, 0), x, z)});
    EXPECT_EQ(edges_not_shared(cut(scene, 0.3)), "");
}

TEST(SharedEdges, StayWholeWhereARugEndsOnThem) {
    const Scene scene = scene_of({rectangle(Vec3(0, 0, 0), x, y), rectangle(x, x, y),
                                  rectangle(Vec3(0.6, 0.23, 0), 0.4 * x, 0.4 * y)});
    EXPECT_EQ(edges_not_shared(cut(scene, 0.3)), "");
}

}  // namespace
}  // namespace patchlight::shared_edges_test
