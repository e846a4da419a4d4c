#include "solver/scene/plane_groups.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::plane_groups_test {
namespace {

/// The walls of the unit cube, each as n × n quads.
Scene tiled_room(int n) {
    Scene tiles = empty_scene();
    for (const Surface& wall : room().surfaces) {
        const Vec3 u = (wall.corners[1] - wall.corners[0]) / n,
                   v = (wall.corners[3] - wall.corners[0]) / n;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                add(tiles, rectangle(wall.corners[0] + i * u + j * v, u, v));
    }
    return tiles;
}

TEST(PlaneGroups, AWallOfManyQuadsIsOne) {
    for (const Motion& motion : {Motion{}, Motion{1e-4, Vec3(1, 2, 3), odd_turn()},
                                 Motion{1e6, Vec3(0, 1e9, 0), odd_turn()}}) {
        const PlaneGroups groups = find_plane_groups(moved(tiled_room(7), motion));
        ASSERT_EQ(groups.size(), 6u) << motion.scale;
        for (std::uint32_t g = 0; g < 6; ++g) EXPECT_EQ(groups.members[g].size(), 49u);
        EXPECT_EQ(groups.of_surface[48], 0u);
        EXPECT_EQ(groups.of_surface[49], 1u);
    }
}

TEST(PlaneGroups, OppositeSidesAndParallelPlanesAreApart) {
    const Polygon square = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
    const Polygon above = rectangle(Vec3(0, 0, 1e-4), Vec3::UnitX(), Vec3::UnitY());
    const PlaneGroups groups =
        find_plane_groups(scene_of({square, reversed(square), above, square}));
    EXPECT_EQ(groups.of_surface, (std::vector<std::uint32_t>{0, 1, 2, 0}));
}

TEST(PlaneGroups, APlaneThatLeansLeavesTheGroup) {
    const Polygon square = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
    const Polygon leaning = rectangle(Vec3(2, 0, 0), Vec3(1, 0, 1e-4), Vec3::UnitY());
    EXPECT_EQ(find_plane_groups(scene_of({square, leaning})).size(), 2u);
}

TEST(PlaneGroups, OfNothingAreNone) { EXPECT_EQ(find_plane_groups(empty_scene()).size(), 0u); }

}  // namespace
}  // namespace patchlight::plane_groups_test
