#include "solver/display/smooth_groups.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace patchlight::smooth_groups_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// How many smooth corners there are at a place.
std::size_t corners_at(const CutScene& cut, const SmoothGroups& groups, const Vec3& p) {
    return static_cast<std::size_t>(std::count_if(
        groups.corners.begin(), groups.corners.end(), [&](const SmoothCorner& corner) {
            return (cut.mesh.vertices[corner.vertex] - p).norm() < 1e-9;
        }));
}

SmoothGroups groups_of(const CutScene& cut) { return find_smooth_groups(cut.scene, cut.mesh); }

TEST(SmoothGroups, AroundAVertexOfAGridAreItsFourPatches) {
    const CutScene plate = cut(scene_of(rectangle(Vec3::Zero(), x, y)), 0.25);
    const SmoothGroups groups = groups_of(plate);
    EXPECT_EQ(groups.corners.size(), 25u);
    std::map<std::size_t, int> sizes;
    for (const SmoothCorner& corner : groups.corners) ++sizes[corner.patches.size()];
    EXPECT_EQ(sizes, (std::map<std::size_t, int>{{1, 4}, {2, 12}, {4, 9}}));
}

TEST(SmoothGroups, OfAPatchNameItInReturn) {
    const CutScene cut_room = cut(room_with_box(), 0.2);
    const SmoothGroups groups = groups_of(cut_room);
    for (PatchIndex i = 0; i < cut_room.mesh.size(); ++i)
        for (std::size_t k = 0; k < 4; ++k) {
            const SmoothCorner& corner = groups.corners[groups.of_patch[i][k]];
            EXPECT_EQ(corner.vertex, cut_room.mesh.patches[i].vertices[k]);
            EXPECT_EQ(std::count(corner.patches.begin(), corner.patches.end(), i), 1);
        }
}

TEST(SmoothGroups, EndAtCreasesOfARoom) {
    Scene scene = room();
    for (Surface& surface : scene.surfaces) surface.object = 0;  // one object, yet three planes
    const CutScene cut_room = cut(scene, 0.5);
    const SmoothGroups groups = groups_of(cut_room);
    EXPECT_EQ(corners_at(cut_room, groups, Vec3::Zero()), 3u);
    EXPECT_EQ(corners_at(cut_room, groups, Vec3(0.5, 0, 0)), 2u);
    EXPECT_EQ(corners_at(cut_room, groups, Vec3(0.5, 0.5, 0)), 1u);
}

/// Strips round a cylinder, as one object.
CutScene cylinder(int strips) {
    Scene scene = empty_scene();
    scene.objects.push_back({"cylinder"});
    const Polygon base = regular(strips, 1.0);
    for (std::size_t k = 0; k < base.size(); ++k)
        add_polygon(scene, 0, white, 0,
                    rectangle(base[k], base[(k + 1) % base.size()] - base[k], z), "");
    return cut(scene, 9.0);
}

TEST(SmoothGroups, RunOnOverFacetsOfAFewDegrees) {
    const CutScene round = cylinder(72), edged = cylinder(24);  // 5 and 15 degrees
    EXPECT_EQ(corners_at(round, groups_of(round), x), 1u);
    EXPECT_EQ(corners_at(edged, groups_of(edged), x), 2u);
}

TEST(SmoothGroups, EndBetweenObjectsMaterialsAndSides) {
    Scene two = scene_of({rectangle(Vec3::Zero(), x, y), rectangle(x, x, y)});
    const CutScene apart = cut(two, 9.0);
    EXPECT_EQ(corners_at(apart, groups_of(apart), x), 2u);
    two.surfaces[1].object = 0;
    const CutScene one_object = cut(two, 9.0);
    EXPECT_EQ(corners_at(one_object, groups_of(one_object), x), 1u);
    two.surfaces[1].material = lamp;
    const CutScene painted = cut(two, 9.0);
    EXPECT_EQ(corners_at(painted, groups_of(painted), x), 2u);
    Scene sheet = empty_scene();
    add(sheet, rectangle(Vec3::Zero(), x, y), two_sided);
    const CutScene both = cut(sheet, 9.0);
    EXPECT_EQ(corners_at(both, groups_of(both), x), 2u);
}

TEST(SmoothGroups, EndWhereAPartitionStands) {
    Scene scene = scene_of(rectangle(Vec3::Zero(), x, y));
    add(scene, rectangle(Vec3(0.5, 0, 0), y, z));
    const CutScene split = cut(scene, 0.25);
    const SmoothGroups groups = groups_of(split);
    EXPECT_EQ(corners_at(split, groups, Vec3(0.5, 0.5, 0)),
              2u + 1u);  // the floor's two, the wall's
    EXPECT_EQ(corners_at(split, groups, Vec3(0.25, 0.5, 0)), 1u);
}

TEST(SmoothGroups, RunOnRoundTheEndOfAPartition) {
    Scene scene = scene_of(rectangle(Vec3::Zero(), x, y));
    add(scene, rectangle(Vec3(0.5, 0, 0), 0.5 * y, z));
    const CutScene split = cut(scene, 0.25);
    const SmoothGroups groups = groups_of(split);
    EXPECT_EQ(corners_at(split, groups, Vec3(0.5, 0.5, 0)), 1u + 1u);
    EXPECT_EQ(corners_at(split, groups, Vec3(0.5, 0.25, 0)), 2u + 1u);
}

TEST(SmoothGroups, LeaveOutCoveredPatches) {
    const CutScene floor = cut(
        scene_of({rectangle(Vec3::Zero(), x, y), rectangle(Vec3(0.25, 0.25, 0), 0.5 * x, 0.5 * y)}),
        0.25);
    for (const SmoothCorner& corner : groups_of(floor).corners)
        for (const PatchIndex i : corner.patches) EXPECT_FALSE(floor.mesh.patches[i].covered);
}

}  // namespace
}  // namespace patchlight::smooth_groups_test
