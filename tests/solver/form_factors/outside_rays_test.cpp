#include "solver/form_factors/outside_rays.h"

#include "solver/form_factors/point_factor.h"
#include "tests/solver/form_factors/engine_scene.h"
#include "tests/solver/form_factors/polygons.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::outside_rays_test {
namespace {

constexpr int rays = 4096;

OutsideRays rays_of(const EngineScene& scene, int count = rays, std::uint64_t seed = 1) {
    return {scene.cut.scene, scene.cut.mesh, scene.rays, count, seed};
}

TEST(OutsideRays, TellBacksFromEscapes) {
    const Polygon plate = rectangle({-0.5, -0.5, 0.5}, Vec3::UnitX(), Vec3::UnitY());  // faces up
    const EngineScene pair(
        scene_of({rectangle({-0.01, -0.01, 0}, 0.02 * Vec3::UnitX(), 0.02 * Vec3::UnitY()), plate}),
        9.0);
    const double hidden =
        point_factor(Vec3::Zero(), Vec3::UnitZ(), convex(reversed(plate)), -Vec3::UnitZ());
    const Outside outside = rays_of(pair).at(0);
    // Binomial at most; 4 sigma: 1 in 16 000.
    const double sigma = std::sqrt(hidden * (1.0 - hidden) / rays);
    EXPECT_NEAR(outside.backs, hidden, 4 * sigma);
    EXPECT_NEAR(outside.escaped, 1.0 - hidden, 4 * sigma);
    EXPECT_EQ(outside.backs + outside.escaped, 1.0);
    EXPECT_EQ(outside.rays, static_cast<std::uint64_t>(rays));
    EXPECT_EQ(rays_of(pair).at(1).escaped, 1.0) << "the plate looks into the open";
}

TEST(OutsideRays, OfAClosedRoomMeetFrontsAlone) {
    const EngineScene closed(room(), 0.25);
    for (const Outside& outside : rays_of(closed).everywhere()) {
        EXPECT_EQ(outside.backs, 0.0);
        EXPECT_EQ(outside.escaped, 0.0);
    }
}

TEST(OutsideRays, OfACoveredPatchLandOnBacks) {
    const Polygon square = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
    const EngineScene two(scene_of({square, square}), 9.0);
    ASSERT_TRUE(two.cut.mesh.patches[0].covered);
    const Outside outside = rays_of(two).at(0);
    EXPECT_EQ(outside.backs, 1.0);
    EXPECT_EQ(outside.rays, 0u);
    EXPECT_EQ(rays_of(two).at(1).escaped, 1.0);
}

TEST(OutsideRays, EverywhereAreThoseOfEachPatch) {
    Scene scene = room_with_box();
    scene.surfaces.erase(scene.surfaces.begin() + 1);
    const EngineScene open(scene, 0.25);
    const OutsideRays some = rays_of(open, 100);
    const std::vector<Outside> all = some.everywhere();
    ASSERT_EQ(all.size(), open.cut.mesh.size());
    double escaped = 0.0;
    for (PatchIndex i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].backs, some.at(i).backs);
        EXPECT_EQ(all[i].escaped, some.at(i).escaped);
        escaped += all[i].escaped;
    }
    EXPECT_GT(escaped, 0.0);
}

}  // namespace
}  // namespace patchlight::outside_rays_test
