#include "solver/scene/far_reaching.h"

#include "solver/scene/local_tolerance.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::far_reaching_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

Scene on_ground(double size, MaterialIndex material = white, const Motion& motion = {}) {
    Scene scene = moved(room_with_box(), {5.0});
    add(scene, rectangle(Vec3(-0.4 * size, -0.5 * size, -0.01), size * x, size * y), material);
    return moved(scene, motion);
}

double area_from(const Scene& scene, SurfaceIndex first, Side side) {
    double area = 0.0;
    for (SurfaceIndex s = first; s < scene.surfaces.size(); ++s)
        if (scene.surfaces[s].side == side) area += scene.surfaces[s].area;
    return area;
}

const auto walls = static_cast<SurfaceIndex>(room_with_box().surfaces.size());

TEST(FarReaching, LeavesScenesOfOneFrameAsTheyAre) {
    for (Scene scene : {room_with_box(), on_ground(100.0)}) {
        const std::size_t before = scene.surfaces.size();
        settle_far_geometry(scene);
        ASSERT_EQ(scene.surfaces.size(), before);
        for (const Surface& surface : scene.surfaces) EXPECT_EQ(surface.coarseness, 1.0);
    }
}

TEST(FarReaching, AGroundUnderARoomIsCutAndKeepsItsArea) {
    for (const double size : {2e4, 2e5, 1e7})
        for (const Motion& motion : {Motion{}, Motion{1.0, Vec3(5e5, 5e6, 0)},
                                     Motion{1.0, Vec3(10, 20, 30), odd_turn()}}) {
            Scene scene = on_ground(size, white, motion);
            settle_far_geometry(scene);
            EXPECT_GT(scene.surfaces.size(), walls + 10u) << size;
            EXPECT_LT(scene.surfaces.size(), walls + 60u) << size;
            EXPECT_NEAR(area_from(scene, walls, Side::front) / (size * size), 1.0, 1e-9) << size;
            for (SurfaceIndex s = 0; s < walls; ++s) EXPECT_EQ(scene.surfaces[s].coarseness, 1.0);
        }
}

TEST(FarReaching, PiecesLieInThePlaneAndAreKnownAsWellAsTheyAreNear) {
    Scene scene = on_ground(2e5, white, {1.0, Vec3::Zero(), odd_turn()});
    const Surface ground = scene.surfaces.back();
    settle_far_geometry(scene);
    const LocalTolerance tolerance(scene);
    for (SurfaceIndex s = walls; s < scene.surfaces.size(); ++s) {
        double nearest = 1e300;
        for (const Vec3& p : scene.surfaces[s].corners) {
            nearest = std::min(nearest, p.norm());
            EXPECT_LT(std::abs((p - ground.corners[0]).dot(ground.normal)), 1e-9) << s;
        }
        EXPECT_GT((scene.surfaces[s].normal).dot(ground.normal), 1.0 - 1e-12);
        EXPECT_LT(tolerance.step(s), 1e-5 * nearest) << s;
    }
}

TEST(FarReaching, BothSidesOfATwoSidedGroundAreCutAlike) {
    Scene scene = on_ground(2e5, two_sided);
    settle_far_geometry(scene);
    EXPECT_NEAR(area_from(scene, walls, Side::back), area_from(scene, walls, Side::front), 1.0);
    EXPECT_NEAR(area_from(scene, walls, Side::back), 4e10, 40.0);
}

TEST(FarReaching, WhatIsFarDoesNotChangeThePatchSize) {
    Scene room = moved(room_with_box(), {5.0}), scene = on_ground(2e5);
    add(scene, rectangle(1e6 * y, 3e4 * x, 3e4 * z));
    settle_far_geometry(scene);
    EXPECT_DOUBLE_EQ(patch_size_for(scene, 300), patch_size_for(room, 300));
    const double size = patch_size_for(room, 300);
    const std::size_t alone = cut(room, size).mesh.size(),
                      with_ground = cut(scene, size).mesh.size();
    EXPECT_GT(with_ground, alone);
    EXPECT_LT(with_ground, 3 * alone);
}

}  // namespace
}  // namespace patchlight::far_reaching_test
