#include "solver/form_factors/ray_cast_engine.h"

#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::ray_cast_engine_test {
namespace {

constexpr int rays = 4096;
constexpr double rounding = 1e-12;  // of sums of a row

TEST(RayCastEngine, FacingUnitSquaresMatchTheClosedForm) {
    const double exact = 0.199824895698387;  // Howell, C-11
    // Hits are binomial at most; 4 sigma, and twenty seeds: 1 in 800 sound engines fail.
    const double sigma = std::sqrt(exact * (1.0 - exact) / rays);
    const EngineScene squares(facing_squares(), 9.0);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const RayCastEngine engine(squares.cut.scene, squares.cut.mesh, squares.rays, rays, seed);
        const FactorRow row = row_of(engine, 0);
        ASSERT_EQ(row.columns, std::vector<PatchIndex>{1});
        EXPECT_NEAR(row.factors[0], exact, 4 * sigma) << seed;
        EXPECT_NEAR(row.variance[0], sigma * sigma, 0.2 * sigma * sigma) << seed;
        EXPECT_NEAR(row.outside->escaped, 1.0 - row.factors[0], rounding);
        EXPECT_EQ(row.outside->backs, 0.0);
        EXPECT_EQ(row.rays, static_cast<std::uint64_t>(rays));
    }
}

TEST(RayCastEngine, EveryRayLandsSomewhere) {
    Scene scene = room_with_box();
    scene.surfaces.erase(scene.surfaces.begin() + 1);  // no ceiling: light escapes
    add(scene, rectangle(Vec3(0.7, 0.2, 0.5), 0.2 * Vec3::UnitX(), 0.2 * Vec3::UnitY()));
    const EngineScene open(scene, 0.2);
    const RayCastEngine engine(open.cut.scene, open.cut.mesh, open.rays, 1000, 1);
    double backs = 0.0, escaped = 0.0;
    for (PatchIndex i = 0; i < open.cut.mesh.size(); ++i) {
        const FactorRow row = row_of(engine, i);
        EXPECT_NEAR(row_sum(row) + row.outside->backs + row.outside->escaped, 1.0, rounding) << i;
        EXPECT_TRUE(std::is_sorted(row.columns.begin(), row.columns.end()));
        EXPECT_EQ(std::count(row.columns.begin(), row.columns.end(), i), 0);
        backs += row.outside->backs;
        escaped += row.outside->escaped;
    }
    EXPECT_GT(backs, 0.0);
    EXPECT_GT(escaped, 0.0);
}

TEST(RayCastEngine, RowsOfAClosedRoomSumToOne) {
    const EngineScene closed(moved(room_with_box(), {1e-3, Vec3(7, 7, 7), odd_turn()}), 2e-4);
    const RayCastEngine engine(closed.cut.scene, closed.cut.mesh, closed.rays, 512, 1);
    const auto& mesh = closed.cut.mesh;
    for (PatchIndex i = 0; i < mesh.first_of_surface[1]; ++i) {
        const FactorRow row = row_of(engine, i);  // under the box there is nothing but its bottom
        EXPECT_NEAR(row_sum(row) + row.outside->backs, 1.0, rounding) << i;
    }
    for (PatchIndex i = mesh.first_of_surface[1]; i < mesh.first_of_surface[6]; ++i)
        EXPECT_NEAR(row_sum(row_of(engine, i)), 1.0, rounding) << i;
}

TEST(RayCastEngine, PatchesOfOneSurfaceDoNotSeeEachOther) {
    const EngineScene closed(room(), 0.25);
    const RayCastEngine engine(closed.cut.scene, closed.cut.mesh, closed.rays, 2048, 1);
    for (PatchIndex i = 0; i < closed.cut.mesh.size(); ++i)
        for (const PatchIndex j : row_of(engine, i).columns)
            EXPECT_NE(closed.cut.mesh.patches[i].surface, closed.cut.mesh.patches[j].surface);
}

TEST(RayCastEngine, ACoveredPatchSeesNothing) {
    const Polygon square = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
    const EngineScene pair(scene_of({square, square}), 9.0);
    const RayCastEngine engine(pair.cut.scene, pair.cut.mesh, pair.rays, 64, 1);
    ASSERT_TRUE(pair.cut.mesh.patches[0].covered);
    const FactorRow row = row_of(engine, 0);
    EXPECT_TRUE(row.columns.empty());
    EXPECT_EQ(row.outside->backs, 1.0);
    EXPECT_EQ(row.outside->rays, 0u);
}

TEST(RayCastEngine, ARowIsTheSameBytesEachTime) {
    const EngineScene closed(room_with_box(), 0.25);
    const RayCastEngine engine(closed.cut.scene, closed.cut.mesh, closed.rays, 300, 5),
        same(closed.cut.scene, closed.cut.mesh, closed.rays, 300, 5),
        other(closed.cut.scene, closed.cut.mesh, closed.rays, 300, 6);
    const PatchIndex ceiling = closed.cut.mesh.first_of_surface[1];
    EXPECT_EQ(row_of(engine, ceiling).factors, row_of(same, ceiling).factors);
    EXPECT_NE(row_of(engine, ceiling).factors, row_of(other, ceiling).factors);
}

}  // namespace
}  // namespace patchlight::ray_cast_engine_test
