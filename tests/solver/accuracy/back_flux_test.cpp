#include "solver/accuracy/back_flux.h"

#include "solver/accuracy/outside_flux.h"
#include "solver/display/flat_corners.h"
#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace patchlight::back_flux_test {
namespace {

/// A scene displayed at one radiosity, on patches uncut.
struct Shown {
    Shown(const Scene& scene, double patch_size, const Rgb& radiosity)
        : of(scene, patch_size),
          planes(find_plane_groups(scene)),
          locator(of.cut.scene, of.cut.mesh, of.rays),
          tree(of.cut.mesh, find_flat_corners(of.cut.mesh, planes)) {
        const std::vector<Rgb> arriving(tree.vertices().size(), Rgb::Ones());
        shown = make_tree_display(of.cut.scene, of.cut.mesh, tree, {arriving, arriving});
        std::fill(shown.display.radiosity.begin(), shown.display.radiosity.end(), radiosity);
    }
    BackGather gather(std::size_t count) const {
        return {of.cut.scene, of.cut.mesh, of.cut.lines.overlaps, of.rays, count, 1};
    }
    BackFlux flux(const BackGather& gather, double noise = 1e-3) const {
        const ShownPlaces places(of.cut.scene, of.cut.mesh, of.rays, locator, tree, shown);
        return gather.flux(shown, places, noise, 65536);
    }
    OutsideFlux counted(const std::vector<bool>& gathered) const {
        return measure_outside(of.cut.scene, of.cut.mesh, shown.display, of.rays, gathered, 65536,
                               1);
    }

    EngineScene of;
    PlaneGroups planes;
    PatchLocator locator;
    RefinementTree tree;
    TreeDisplay shown;
};

/// The unit cube, with a square of 0.2 m below its ceiling that faces down.
Scene room_with_panel() {
    Scene scene = room();
    add(scene, rectangle(Vec3(0.4, 0.4, 0.8), 0.2 * Vec3::UnitY(), 0.2 * Vec3::UnitX()));
    return scene;
}

TEST(BackGather, OfAPanelInABrightRoomIsItsAreaTimesTheLight) {
    const Rgb light(1.0, 2.0, 4.0);
    const Shown room(room_with_panel(), 0.5, light);
    const BackGather gather = room.gather(4096);
    const std::vector<bool> panel_alone{false, false, false, false, false, false, true};
    EXPECT_EQ(gather.gathered(), panel_alone) << "walls face away";
    const BackFlux found = room.flux(gather);
    for (int c = 0; c < 3; ++c)  // every ray says the same
        EXPECT_NEAR(found.flux[c], 0.04 * light[c], 1e-9);
    EXPECT_LT(found.variance.maxCoeff(), 1e-12);
}

TEST(BackGather, LeavesNoMoreNoiseThanItIsAllowed) {
    Shown room(room_with_panel(), 0.5, Rgb::Ones());
    for (std::size_t v = 0; v < room.shown.display.positions.size(); ++v)  // one wall is dark
        if (room.shown.display.positions[v].x() < 1e-9)
            room.shown.display.radiosity[v] = Rgb::Zero();
    const BackGather gather = room.gather(4096);
    for (const double noise : {1e-3, 1e-4}) {
        const BackFlux found = room.flux(gather, noise);
        EXPECT_GT(found.variance[0], 0.0);
        EXPECT_LT(std::sqrt(found.variance[0]), 1.5 * noise);
    }
}

TEST(BackGather, WhatIsGatheredIsNotCounted) {
    const Shown room(room_with_panel(), 0.5, Rgb::Ones());
    const OutsideFlux counted = room.counted(std::vector<bool>(7, false));
    // Four standard errors: one false alarm in 16,000 seeds.
    EXPECT_NEAR(counted.backs[0], 0.04, 4.0 * counted.standard_error[0]);
    EXPECT_GT(counted.backs[0], 0.0);
    EXPECT_EQ(room.counted(room.gather(4096).gathered()).backs[0], 0.0);
}

TEST(BackGather, ASurfaceThatIsLitFromBothSidesHasNoBack) {
    Scene scene = room();
    add(scene, rectangle(Vec3(0.4, 0.4, 0.8), 0.2 * Vec3::UnitY(), 0.2 * Vec3::UnitX()), two_sided);
    const Shown room(scene, 0.5, Rgb::Ones());
    EXPECT_EQ(room.flux(room.gather(65536)).flux[0], 0.0);
    EXPECT_EQ(room.counted(room.gather(65536).gathered()).backs[0], 0.0);
}

TEST(BackGather, AWallWithoutThicknessHasNoBack) {
    Scene scene = room();
    add_box(scene, Vec3(1, 0, 0), Vec3(2, 1, 1), Facing::inwards);
    const Shown rooms(scene, 0.5, Rgb::Ones());
    const BackGather gather = rooms.gather(65536);
    EXPECT_EQ(gather.gathered(), std::vector<bool>(12, false));
    EXPECT_EQ(rooms.flux(gather).flux[0], 0.0);
    EXPECT_EQ(rooms.counted(gather.gathered()).backs[0], 0.0);
}

TEST(BackGather, IsLeftOutWhereThereAreTooManySurfaces) {
    const Shown room(room_with_panel(), 0.5, Rgb::Ones());
    const BackGather gather = room.gather(64);
    EXPECT_EQ(gather.gathered(), std::vector<bool>(7, false));
    EXPECT_EQ(room.flux(gather).flux[0], 0.0);
}

}  // namespace
}  // namespace patchlight::back_flux_test
