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
    BackFlux backs(std::size_t count, std::uint64_t seed = 1) const {
        const ShownPlaces places(of.cut.scene, of.cut.mesh, of.rays, locator, tree, shown);
        return gather_at_backs(of.cut.scene, of.cut.mesh, of.rays, shown, places, count, seed);
    }
    OutsideFlux outside(const BackFlux& backs, std::size_t count) const {
        return measure_outside(of.cut.scene, of.cut.mesh, shown.display, of.rays, backs, count, 1);
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

TEST(BackFlux, OfAPanelInABrightRoomIsItsAreaTimesTheLight) {
    const Rgb light(1.0, 2.0, 4.0);
    const Shown room(room_with_panel(), 0.5, light);
    const BackFlux found = room.backs(4096);
    EXPECT_TRUE(found.gathered[6]);
    for (int c = 0; c < 3; ++c)  // every ray says the same
        EXPECT_NEAR(found.flux[c], 0.04 * light[c], 1e-9);
    EXPECT_LT(found.variance.maxCoeff(), 1e-12);
    for (SurfaceIndex s = 0; s < 6; ++s) EXPECT_FALSE(found.gathered[s]) << "walls face away";
}

TEST(BackFlux, IsNotCountedTwice) {
    const Shown room(room_with_panel(), 0.5, Rgb::Ones());
    BackFlux none;
    none.gathered.assign(7, false);
    const OutsideFlux counted = room.outside(none, 65536),
                      gathered = room.outside(room.backs(4096), 65536);
    EXPECT_NEAR(gathered.backs[0], 0.04, 1e-9);
    // Four standard errors: one false alarm in 16,000 seeds.
    EXPECT_NEAR(counted.backs[0], 0.04, 4.0 * counted.standard_error[0]);
    EXPECT_LT(gathered.standard_error[0], 0.01 * counted.standard_error[0]);
}

TEST(BackFlux, ASurfaceThatIsLitFromBothSidesHasNoBack) {
    Scene scene = room();
    add(scene, rectangle(Vec3(0.4, 0.4, 0.8), 0.2 * Vec3::UnitY(), 0.2 * Vec3::UnitX()), two_sided);
    const Shown room(scene, 0.5, Rgb::Ones());
    const BackFlux found = room.backs(65536);
    EXPECT_EQ(found.flux[0], 0.0);
    EXPECT_EQ(room.outside(found, 4096).backs[0], 0.0);
}

TEST(BackFlux, IsLeftOutWhereThereAreTooManySurfaces) {
    const Shown room(room_with_panel(), 0.5, Rgb::Ones());
    const BackFlux found = room.backs(64);
    EXPECT_EQ(found.flux[0], 0.0);
    EXPECT_EQ(found.gathered, std::vector<bool>(7, false));
}

}  // namespace
}  // namespace patchlight::back_flux_test
