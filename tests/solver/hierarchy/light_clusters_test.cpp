#include "solver/hierarchy/light_clusters.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <numeric>

namespace patchlight::light_clusters_test {
namespace {

/// A room with a box, and a thin wall that shows both sides.
CutScene furnished() {
    Scene scene = room_with_box();
    const Polygon wall = rectangle({0.1, 0.8, 0.0}, Vec3(0.3, 0, 0), Vec3(0, 0, 0.4));
    add(scene, wall);
    Polygon back = reversed(wall);
    for (Vec3& p : back) p.y() -= 1e-3;
    add(scene, back);
    return cut(scene, 0.05);
}

class LightClusterCount : public testing::TestWithParam<std::size_t> {};

TEST_P(LightClusterCount, HoldEachPatchOnceAndItsAreaWithIt) {
    const CutScene pieces = furnished();
    const LightClusters clusters = make_light_clusters(pieces.scene, pieces.mesh, GetParam());
    EXPECT_EQ(clusters.size(), std::min(GetParam(), clusters.patches.size()));
    std::vector<int> times(pieces.mesh.size(), 0);
    double area = 0.0, expected = 0.0;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        ASSERT_FALSE(clusters.members(c).empty());
        double sum = 0.0;
        for (const PatchIndex i : clusters.members(c)) {
            EXPECT_EQ(clusters.of_patch[i], c);
            ++times[i];
            sum += pieces.mesh.patches[i].area;
        }
        EXPECT_NEAR(clusters.area[c], sum, 1e-12 * sum);
        area += clusters.area[c];
    }
    for (PatchIndex i = 0; i < pieces.mesh.size(); ++i) {
        EXPECT_EQ(times[i], pieces.mesh.patches[i].covered ? 0 : 1);
        if (!pieces.mesh.patches[i].covered) expected += pieces.mesh.patches[i].area;
    }
    EXPECT_NEAR(area, expected, 1e-9 * expected);
}

INSTANTIATE_TEST_SUITE_P(Each, LightClusterCount,
                         testing::Values(1u, 2u, 7u, 100u, 1000u, 1'000'000u));

/// Light on one side says nothing of that on the other.
TEST(LightClusters, DivideTheSidesOfAThinWall) {
    const CutScene pieces = furnished();
    const LightClusters clusters = make_light_clusters(pieces.scene, pieces.mesh, 400);
    for (std::size_t c = 0; c < clusters.size(); ++c)
        for (const PatchIndex i : clusters.members(c)) {
            const PatchIndex first = clusters.members(c).front();
            const auto normal = [&](PatchIndex k) {
                return pieces.scene.surfaces[pieces.mesh.patches[k].surface].normal;
            };
            EXPECT_GT(normal(i).dot(normal(first)), -0.5) << "cluster " << c;
        }
}

TEST(LightClusters, AreTheSameEachTime) {
    const CutScene pieces = furnished();
    const LightClusters one = make_light_clusters(pieces.scene, pieces.mesh, 50),
                        other = make_light_clusters(pieces.scene, pieces.mesh, 50);
    EXPECT_EQ(one.patches, other.patches);
    EXPECT_EQ(one.first, other.first);
}

}  // namespace
}  // namespace patchlight::light_clusters_test
