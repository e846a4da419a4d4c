#include "solver/mesh/make_patches.h"

#include "tests/solver/mesh/mesh_checks.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight::covers_and_creases_test {
namespace {

constexpr double cover_rounding = 1e-9;  // of areas between crossing outlines [m²]
constexpr double area_rounding = 1e-12;  // sums of some thousand areas, relative
constexpr double ties = 0.1;  // patches whose two diagonals are as good: rounding chooses [1]
constexpr double outline_rounding = 1e-9;  // vertices within it of an edge are taken to be on it

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

Polygon square() { return rectangle(Vec3::Zero(), x, y); }

void expect_sound(const CutScene& cut) {
    EXPECT_LT(area_error(cut), area_rounding);
    EXPECT_LT(longest_edge(cut), 1.0 + 1e-8);
    EXPECT_GT(least_sine(cut), 0.0);
    for (SurfaceIndex s = 0; s < cut.scene.surfaces.size(); ++s) {
        EXPECT_EQ(edges_shared_wrongly(cut, s), 0u) << s;
        EXPECT_NEAR(excess_outline(cut, s), 0.0, outline_rounding) << s;
        EXPECT_EQ(points_not_in_one_patch(cut, s, 300, 1), 0) << s;
        EXPECT_EQ(patches_cut_by_contacts(cut, s), 0) << s;
    }
}

TEST(Covers, ARugHidesExactlyWhatLiesUnderIt) {
    for (const double size : {0.5, 0.2, 0.07}) {
        const CutScene floor =
            cut(scene_of({square(), rectangle(Vec3(0.31, 0.27, 0), 0.33 * x, 0.41 * y)}), size);
        EXPECT_NEAR(covered_area(floor, 0), 0.33 * 0.41, cover_rounding) << size;
        EXPECT_EQ(covered_area(floor, 1), 0.0);
        expect_sound(floor);
    }
}

TEST(Covers, ATurnedRugOverTheEdgeHidesThePartOnTheFloor) {
    // A square on its corner about the floor's corner: a quarter of it lies on the floor.
    const Polygon rug = flat({{0.4, 0}, {0, 0.4}, {-0.4, 0}, {0, -0.4}});
    const CutScene floor = cut(scene_of({square(), rug}), 0.15);
    EXPECT_NEAR(covered_area(floor, 0), 0.08, cover_rounding);
    expect_sound(floor);
}

TEST(Covers, ARoundLampHidesItsDiskOfTheCeiling) {
    const Motion placed{0.3, Vec3(0.5, 0.5, 0)};
    const CutScene ceiling = cut(scene_of({square(), moved(regular(32, 1.0), placed)}), 0.12);
    const double disk = 16 * std::sin(2 * std::numbers::pi / 32) * 0.09;
    EXPECT_NEAR(covered_area(ceiling, 0), disk, cover_rounding);
    expect_sound(ceiling);
}

TEST(Covers, TwoRugsOnOneAnotherHideTheirUnionOfTheFloor) {
    const CutScene floor = cut(scene_of({square(), rectangle(Vec3(0.2, 0.2, 0), 0.4 * x, 0.4 * y),
                                         rectangle(Vec3(0.4, 0.4, 0), 0.4 * x, 0.4 * y)}),
                               0.15);
    EXPECT_NEAR(covered_area(floor, 0), 0.28, cover_rounding);
    EXPECT_NEAR(covered_area(floor, 1), 0.04, cover_rounding);
    EXPECT_EQ(covered_area(floor, 2), 0.0);
    expect_sound(floor);
}

TEST(Covers, ARugAsLargeAsTheFloorHidesAllOfIt) {
    const CutScene floor = cut(scene_of({square(), square()}), 0.2);
    EXPECT_NEAR(covered_area(floor, 0), 1.0, cover_rounding);
    EXPECT_EQ(covered_area(floor, 1), 0.0);
    EXPECT_LT(area_error(floor), area_rounding);
}

TEST(Covers, AnOpposedPartnerHidesNothing) {
    const CutScene wall = cut(scene_of({square(), reversed(square())}), 0.2);
    EXPECT_EQ(covered_area(wall, 0), 0.0);
    EXPECT_EQ(covered_area(wall, 1), 0.0);
}

TEST(Creases, NoPatchStraddlesTheFootOfABox) {
    for (const double size : {0.5, 0.2, 0.07}) {
        const CutScene box = cut(room_with_box(), size);
        ASSERT_FALSE(box.lines.creases[0].empty());
        expect_sound(box);
    }
}

TEST(Creases, NoPatchStraddlesTheFootOfATurnedBox) {
    Scene scene = room();
    Scene box = empty_scene();
    add_box(box, Vec3(-0.2, -0.15, 0), Vec3(0.2, 0.15, 0.4), Facing::outwards);
    const Motion turned{1.0, Vec3(0.45, 0.55, 0), Eigen::AngleAxisd(0.37, z).toRotationMatrix()};
    for (const Surface& surface : moved(box, turned).surfaces) add(scene, surface.corners);
    expect_sound(cut(scene, 0.11));
}

TEST(Creases, NoPatchStraddlesAPartition) {
    Scene scene = room();
    add(scene, rectangle(Vec3(0.43, 0, 0), y, z), two_sided);
    expect_sound(cut(scene, 0.19));
}

TEST(Creases, NoPatchStraddlesAWallThatPassesThrough) {
    Scene scene = room();
    add(scene, rectangle(Vec3(0.31, 0.2, -0.4), 0.3 * x + 0.5 * y, z), two_sided);
    expect_sound(cut(scene, 0.19));
}

TEST(Creases, ThatCrossOneAnotherAreAllKept) {
    Scene scene = scene_of(square());
    for (const double at : {0.21, 0.47, 0.73}) {
        add(scene, rectangle(Vec3(at, 0.1, 0), 0.8 * y, 0.3 * z));
        add(scene, rectangle(Vec3(0.1, at + 0.03, 0), 0.8 * x, 0.3 * z));
    }
    expect_sound(cut(scene, 0.2));
}

TEST(Creases, AlmostOnTheOutlineDoNoHarm) {
    for (const double gap : {1e-3, 1e-5, 2e-6, 1e-7}) {
        Scene scene = room();
        add_box(scene, Vec3(gap, 0.3, 0), Vec3(0.4, 0.6, 0.5), Facing::outwards);
        const CutScene near_wall = cut(scene, 0.2);
        EXPECT_LT(area_error(near_wall), area_rounding) << gap;
        EXPECT_LT(longest_edge(near_wall), 1.0 + 1e-8) << gap;
        EXPECT_GT(least_sine(near_wall), 0.0) << gap;
    }
}

/// A room with what gives rise to every kind of patch.
Scene furnished() {
    Scene scene = room_with_box();
    add(scene, moved(regular(16, 0.2), {1.0, Vec3(0.7, 0.7, 0)}));
    add(scene, moved(l_shape(), {0.1, Vec3(0.1, 0.75, 0)}));
    return scene;
}

TEST(MakePatches, ScalesWithTheScene) {
    const CutScene unit = cut(furnished(), 0.15);
    for (const double scale : {0x1p-14, 0x1p20}) {  // powers of two: rounding scales too
        const CutScene scaled = cut(moved(furnished(), {scale}), 0.15 * scale);
        ASSERT_EQ(scaled.mesh.size(), unit.mesh.size()) << scale;
        for (PatchIndex i = 0; i < unit.mesh.size(); ++i) {
            EXPECT_EQ(scaled.mesh.patches[i].vertices, unit.mesh.patches[i].vertices) << scale;
            EXPECT_EQ(scaled.mesh.patches[i].covered, unit.mesh.patches[i].covered) << scale;
        }
    }
}

class EveryScale : public testing::TestWithParam<double> {};

TEST_P(EveryScale, TheMeshIsAsSound) {
    const double scale = GetParam();
    const CutScene unit = cut(furnished(), 0.15);
    const CutScene scaled = cut(moved(furnished(), {scale}), 0.15 * scale);
    ASSERT_EQ(scaled.mesh.size(), unit.mesh.size());
    int lost = 0;  // patches of the one that the other has not
    for (const Patch& patch : unit.mesh.patches)
        lost += std::none_of(scaled.mesh.patches.begin(), scaled.mesh.patches.end(),
                             [&](const Patch& p) {
                                 return p.surface == patch.surface &&
                                        (p.centre / scale - patch.centre).norm() < 1e-9;
                             });
    EXPECT_LE(lost, ties * static_cast<double>(unit.mesh.size()));
    EXPECT_NEAR(covered_area(scaled, 0) / scale / scale, covered_area(unit, 0), cover_rounding);
    expect_sound(scaled);
}

INSTANTIATE_TEST_SUITE_P(MakePatches, EveryScale, testing::Values(1e-4, 0.01, 3.0, 1e3, 1e6));

}  // namespace
}  // namespace patchlight::covers_and_creases_test
