#include "solver/form_factors/patch_clusters.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::patch_clusters_test {
namespace {

constexpr double rounding = 1e-12;

CutScene furnished() {
    Scene scene = room_with_box();
    add(scene, moved(star(5, 0.4), {0.2, Vec3(0.7, 0.6, 0.7), odd_turn()}));
    return cut(scene, 0.07);
}

PatchClusters clusters_of(const CutScene& cut_scene) {
    return make_clusters(cut_scene.scene, cut_scene.mesh, find_plane_groups(cut_scene.scene));
}

TEST(PatchClusters, AreOfOnePlaneEachAndAscend) {
    const CutScene cut_scene = furnished();
    const PatchClusters clusters = clusters_of(cut_scene);
    const PlaneGroups groups = find_plane_groups(cut_scene.scene);
    EXPECT_TRUE(std::is_sorted(clusters.group.begin(), clusters.group.end()));
    for (PatchIndex i = 0; i < cut_scene.mesh.size(); ++i)
        EXPECT_EQ(clusters.group[clusters.of_patch[i]],
                  groups.of_surface[cut_scene.mesh.patches[i].surface]);
}

TEST(PatchClusters, AreOfSomeSixteenPatches) {
    const CutScene cut_scene = furnished();
    const PatchClusters clusters = clusters_of(cut_scene);
    std::vector<int> sizes(clusters.size(), 0);
    for (const std::uint32_t c : clusters.of_patch) ++sizes[c];
    EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()), 16);
    EXPECT_GE(*std::min_element(sizes.begin(), sizes.end()), 1);
    EXPECT_GT(static_cast<double>(cut_scene.mesh.size()) / static_cast<double>(sizes.size()), 6.0);
}

TEST(PatchClusters, LieWithinTheHullOfTheirPoints) {
    const CutScene cut_scene = furnished();
    const PatchClusters clusters = clusters_of(cut_scene);
    std::mt19937 chance(1);
    for (PatchIndex i = 0; i < cut_scene.mesh.size(); ++i)
        for (int n = 0; n < 10; ++n) {
            const Vec3 direction = random_direction(chance);
            double reach = -1e300;
            for (const Vec3& p : clusters.points(clusters.of_patch[i]))
                reach = std::max(reach, p.dot(direction));
            for (const Vec3& p : patch_corners(cut_scene.mesh, i))
                EXPECT_LE(p.dot(direction), reach + rounding);
        }
}

}  // namespace
}  // namespace patchlight::patch_clusters_test
