#include "solver/form_factors/blocker_table.h"

#include "solver/scene/polygon.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::blocker_table_test {
namespace {

constexpr int segments_per_pair = 200;
constexpr double grazing = 1e-9;  // of the scene's size: a touch is no crossing [1]

/// Whether the segment passes through the inside of the surface: double arithmetic, no rays.
bool crosses(const Surface& surface, const Vec3& p, const Vec3& q) {
    const double at_p = (p - surface.corners[0]).dot(surface.normal),
                 at_q = (q - surface.corners[0]).dot(surface.normal);
    if (std::min(at_p, at_q) > -grazing || std::max(at_p, at_q) < grazing) return false;
    const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
    std::vector<Vec2> outline;
    for (const Vec3& corner : surface.corners) outline.push_back(frame.flat(corner));
    return contains(outline, frame.flat(p + (q - p) * (at_p / (at_p - at_q))));
}

bool is_blocked(const CutScene& cut, PatchIndex i, PatchIndex j, const Vec3& p, const Vec3& q) {
    const SurfaceIndex own_i = cut.mesh.patches[i].surface, own_j = cut.mesh.patches[j].surface;
    for (SurfaceIndex s = 0; s < cut.scene.surfaces.size(); ++s)
        if (s != own_i && s != own_j && crosses(cut.scene.surfaces[s], p, q)) return true;
    return false;
}

Scene random_boxes(unsigned seed) {
    std::mt19937 chance(seed);
    Scene scene = room();
    for (int n = 0; n < 4; ++n) {
        const Vec3 size =
            0.1 * Vec3::Ones() + 0.3 * Vec3(uniform(chance), uniform(chance), uniform(chance));
        Scene box = empty_scene();
        add_box(box, -0.5 * size, 0.5 * size, Facing::outwards);
        const Vec3 place =
            0.3 * Vec3::Ones() + 0.4 * Vec3(uniform(chance), uniform(chance), uniform(chance));
        const bool upright = n % 2 == 0;
        const Motion motion{1.0, upright ? Vec3(place.x(), place.y(), 0.5 * size.z()) : place,
                            upright ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : odd_turn()};
        for (const Surface& side : moved(box, motion).surfaces) add(scene, side.corners);
    }
    return scene;
}

TEST(BlockerTable, NeverOverlooksABlocker) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const CutScene boxes = cut(random_boxes(seed), 0.25);
        const BlockerTable table(boxes.scene, boxes.mesh, find_plane_groups(boxes.scene));
        std::mt19937 chance(seed);
        int cleared = 0, overlooked = 0;
        for (int pair = 0; pair < 8000; ++pair) {
            const auto i = static_cast<PatchIndex>(uniform(chance) *
                                                   static_cast<double>(boxes.mesh.size())),
                       j = static_cast<PatchIndex>(uniform(chance) *
                                                   static_cast<double>(boxes.mesh.size()));
            if (boxes.mesh.patches[i].surface == boxes.mesh.patches[j].surface) continue;
            if (table.may_block(i, j)) continue;
            ++cleared;
            const Vec3 &normal_i = boxes.scene.surfaces[boxes.mesh.patches[i].surface].normal,
                       &normal_j = boxes.scene.surfaces[boxes.mesh.patches[j].surface].normal;
            for (int n = 0; n < segments_per_pair; ++n) {
                const Vec3 p = random_point(boxes.mesh, i, chance),
                           q = random_point(boxes.mesh, j, chance);
                if ((q - p).dot(normal_i) <= grazing || (p - q).dot(normal_j) <= grazing) continue;
                overlooked += is_blocked(boxes, i, j, p, q);
            }
        }
        EXPECT_EQ(overlooked, 0) << seed;
        EXPECT_GT(cleared, 500) << seed;
    }
}

TEST(BlockerTable, IsSymmetric) {
    const CutScene boxes = cut(random_boxes(4), 0.3);
    const BlockerTable table(boxes.scene, boxes.mesh, find_plane_groups(boxes.scene));
    for (PatchIndex i = 0; i < boxes.mesh.size(); ++i)
        for (PatchIndex j = 0; j < i; ++j)
            ASSERT_EQ(table.may_block(i, j), table.may_block(j, i)) << i << ' ' << j;
}

TEST(BlockerTable, FindsNothingInTheWayInAnEmptyRoom) {
    for (const Motion& motion : {Motion{}, Motion{1e-4, Vec3(1, 2, 3), odd_turn()},
                                 Motion{1e6, Vec3(1e9, 0, 0), odd_turn() * odd_turn()}}) {
        const CutScene empty = cut(moved(room(), motion), 0.13 * motion.scale);
        const BlockerTable table(empty.scene, empty.mesh, find_plane_groups(empty.scene));
        int may = 0;
        for (PatchIndex i = 0; i < empty.mesh.size(); ++i)
            for (PatchIndex j = 0; j < empty.mesh.size(); ++j) may += table.may_block(i, j);
        EXPECT_EQ(may, 0) << motion.scale;
    }
}

TEST(BlockerTable, FindsNothingInTheWayInAnEmptyPrism) {
    Scene prism = scene_of({reversed(regular(7, 1.0, 1.0)), regular(7, 1.0)});
    for (std::size_t k = 0; k < 7; ++k) {
        const Polygon base = regular(7, 1.0);
        const Vec3 &a = base[k], &b = base[(k + 1) % 7];
        add(prism, rectangle(b, a - b, Vec3::UnitZ()));
    }
    const CutScene empty = cut(moved(prism, {1.0, Vec3(4, 4, 4), odd_turn()}), 0.2);
    const BlockerTable table(empty.scene, empty.mesh, find_plane_groups(empty.scene));
    int may = 0;
    for (PatchIndex i = 0; i < empty.mesh.size(); ++i)
        for (PatchIndex j = 0; j < empty.mesh.size(); ++j) may += table.may_block(i, j);
    EXPECT_EQ(may, 0);
}

TEST(BlockerTable, AWallInPiecesIsNoMoreInTheWayThanAWhole) {
    Scene tiles = empty_scene();
    for (const Surface& wall : room().surfaces) {
        const Vec3 u = (wall.corners[1] - wall.corners[0]) / 14.0,
                   v = (wall.corners[3] - wall.corners[0]) / 14.0;
        for (int k = 0; k < 14 * 14; ++k)
            add(tiles, rectangle(wall.corners[0] + (k % 14) * u + (k / 14) * v, u, v));
    }
    const CutScene pieces = cut(tiles, 9.0);
    ASSERT_EQ(pieces.mesh.size(), 1176u);
    const BlockerTable table(pieces.scene, pieces.mesh, find_plane_groups(pieces.scene));
    int may = 0;
    for (PatchIndex i = 0; i < pieces.mesh.size(); ++i)
        for (PatchIndex j = 0; j < pieces.mesh.size(); ++j) may += table.may_block(i, j);
    EXPECT_EQ(may, 0);
}

TEST(BlockerTable, StoppedItRulesNothingOut) {
    const CutScene empty = cut(room(), 0.5);
    int asked = 0;
    const BlockerTable table(empty.scene, empty.mesh, find_plane_groups(empty.scene),
                             [&] { return ++asked < 2; });
    EXPECT_EQ(asked, 2);
    EXPECT_TRUE(table.may_block(0, static_cast<PatchIndex>(empty.mesh.size() - 1)));
}

TEST(BlockerTable, NamesPairsWithABoxBetween) {
    const CutScene room = cut(room_with_box(), 0.05);
    const BlockerTable table(room.scene, room.mesh, find_plane_groups(room.scene));
    const auto patch_at = [&](const Vec3& p) {
        PatchIndex nearest = 0;
        for (PatchIndex i = 0; i < room.mesh.size(); ++i)
            if ((room.mesh.patches[i].centre - p).norm() <
                (room.mesh.patches[nearest].centre - p).norm())
                nearest = i;
        return nearest;
    };
    EXPECT_TRUE(table.may_block(patch_at(Vec3(0, 0.45, 0.2)), patch_at(Vec3(1, 0.45, 0.2))));
    EXPECT_FALSE(table.may_block(patch_at(Vec3(0, 0.45, 0.95)), patch_at(Vec3(1, 0.45, 0.95))));
    EXPECT_FALSE(table.may_block(patch_at(Vec3(0.9, 0, 0.2)), patch_at(Vec3(0.9, 1, 0.2))));
}

}  // namespace
}  // namespace patchlight::blocker_table_test
