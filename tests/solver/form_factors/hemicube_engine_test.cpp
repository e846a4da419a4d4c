#include "solver/form_factors/hemicube_engine.h"

#include "solver/form_factors/point_factor.h"
#include "tests/solver/form_factors/engine_scene.h"
#include "tests/solver/form_factors/polygons.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::hemicube_engine_test {
namespace {

constexpr double rounding = 1e-12;  // of sums of a row

HemicubeEngine engine_of(const EngineScene& scene, int resolution, int sub_samples = 0,
                         bool rotated = true, std::uint64_t seed = 1) {
    HemicubeSettings settings;
    settings.resolution = resolution;
    settings.sub_samples = sub_samples;
    settings.rotated = rotated;
    settings.seed = seed;
    return {scene.cut.scene, scene.cut.mesh, scene.rays, settings};
}

double factor_to(const FactorRow& row, PatchIndex j) {
    const auto at = std::lower_bound(row.columns.begin(), row.columns.end(), j);
    if (at == row.columns.end() || *at != j) return 0.0;
    return row.factors[static_cast<std::size_t>(at - row.columns.begin())];
}

TEST(HemicubeEngine, StandsTurnedOtherwiseOnEachPatch) {
    const EngineScene cube(room(), 1.0);  // a patch a wall: all alike but for the turn
    const HemicubeEngine turned = engine_of(cube, 33, 1), straight = engine_of(cube, 33, 1, false);
    std::vector<double> opposite;
    for (PatchIndex i = 0; i < 6; ++i) {
        opposite.push_back(factor_to(row_of(turned, i), i ^ 1u));
        EXPECT_NEAR(factor_to(row_of(straight, i), i ^ 1u), factor_to(row_of(straight, 0), 1),
                    rounding);
    }
    std::sort(opposite.begin(), opposite.end());
    EXPECT_GE(std::unique(opposite.begin(), opposite.end()) - opposite.begin(), 5)
        << "turns that give the very same count are rare";
}

TEST(HemicubeEngine, ARowIsTheSameBytesEachTime) {
    const EngineScene closed(room_with_box(), 0.25);
    const HemicubeEngine engine = engine_of(closed, 48), same = engine_of(closed, 48),
                         other = engine_of(closed, 48, 0, true, 2);
    const PatchIndex ceiling = closed.cut.mesh.first_of_surface[1];
    const FactorRow row = row_of(engine, ceiling), again = row_of(engine, ceiling);
    EXPECT_EQ(row.factors, again.factors);
    EXPECT_EQ(row.variance, again.variance);
    EXPECT_EQ(row.factors, row_of(same, ceiling).factors);
    EXPECT_NE(row.factors, row_of(other, ceiling).factors);
}

TEST(HemicubeEngine, EveryCellSeesSomething) {
    Scene scene = room_with_box();
    scene.surfaces.erase(scene.surfaces.begin() + 1);  // no ceiling: light escapes
    add(scene, rectangle(Vec3(0.7, 0.2, 0.5), 0.2 * Vec3::UnitX(), 0.2 * Vec3::UnitY()));
    const EngineScene open(scene, 0.2);
    for (const int resolution : {2, 31, 32, 33}) {
        const HemicubeEngine engine = engine_of(open, resolution);
        double backs = 0.0, escaped = 0.0;
        for (PatchIndex i = 0; i < open.cut.mesh.size(); ++i) {
            const FactorRow row = row_of(engine, i);
            ASSERT_NEAR(row_sum(row) + row.outside->backs + row.outside->escaped, 1.0, rounding);
            ASSERT_TRUE(std::is_sorted(row.columns.begin(), row.columns.end()));
            ASSERT_EQ(std::count(row.columns.begin(), row.columns.end(), i), 0);
            for (const PatchIndex j : row.columns)
                ASSERT_NE(open.cut.mesh.patches[j].surface, open.cut.mesh.patches[i].surface);
            backs += row.outside->backs;
            escaped += row.outside->escaped;
        }
        EXPECT_GT(backs, 0.0);
        EXPECT_GT(escaped, 0.0);
    }
}

TEST(HemicubeEngine, RowsOfAClosedRoomSumToOne) {
    const EngineScene closed(moved(room_with_box(), {1e-3, Vec3(7, 7, 7), odd_turn()}), 2e-4);
    const auto& mesh = closed.cut.mesh;
    const HemicubeEngine engine = engine_of(closed, 33);
    for (PatchIndex i = 0; i < mesh.first_of_surface[6]; ++i) {
        const FactorRow row = row_of(engine, i);
        EXPECT_EQ(row.outside->escaped, 0.0) << i;
        // Under the box the floor sees nothing but its bottom's back.
        if (i >= mesh.first_of_surface[1]) {
            EXPECT_NEAR(row_sum(row), 1.0, rounding) << i;
        }
    }
}

TEST(HemicubeEngine, TellsBacksFromEscapes) {
    const Polygon plate = rectangle({-0.5, -0.5, 0.5}, Vec3::UnitX(), Vec3::UnitY());  // faces up
    const EngineScene pair(
        scene_of({rectangle({-0.05, -0.05, 0}, 0.1 * Vec3::UnitX(), 0.1 * Vec3::UnitY()), plate}),
        9.0);
    const double hidden =
        point_factor(Vec3::Zero(), Vec3::UnitZ(), convex(reversed(plate)), -Vec3::UnitZ());
    const FactorRow row = row_of(engine_of(pair, 256, 1), 0);
    constexpr double aliasing = 2e-3;  // three times 1 / 256 to the power 3/2, and some
    EXPECT_TRUE(row.columns.empty());
    EXPECT_NEAR(row.outside->backs, hidden, aliasing);
    EXPECT_NEAR(row.outside->escaped, 1.0 - hidden, aliasing);
    const Outside outside = engine_of(pair, 256, 1).outside(0);
    EXPECT_EQ(outside.backs, row.outside->backs);
    EXPECT_EQ(outside.escaped, row.outside->escaped);
}

TEST(HemicubeEngine, UsesMorePartsBesideAWallThanInTheMiddle) {
    const EngineScene closed(room(), 0.125);  // rows of eight
    const HemicubeEngine engine = engine_of(closed, 32);
    EXPECT_EQ(engine.sub_samples(0), 4);
    EXPECT_EQ(engine.sub_samples(3), 4) << "beside one wall";
    EXPECT_EQ(engine.sub_samples(8 + 3), 3) << "one off";
    EXPECT_EQ(engine.sub_samples(3 * 8 + 3), 1) << "four patches from any other";
    EXPECT_EQ(row_of(engine, 0).samples, 16);
    EXPECT_EQ(row_of(engine, 3 * 8 + 3).samples, 1);
    EXPECT_EQ(engine_of(closed, 32, 2).sub_samples(0), 2) << "as asked";
}

TEST(HemicubeEngine, ACoveredPatchSeesNothing) {
    const Polygon square = rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY());
    const Polygon above = rectangle(Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX());
    const EngineScene three(scene_of({square, square, above}), 9.0);
    ASSERT_TRUE(three.cut.mesh.patches[0].covered);
    const HemicubeEngine engine = engine_of(three, 32);
    const FactorRow row = row_of(engine, 0);
    EXPECT_TRUE(row.columns.empty());
    EXPECT_EQ(row.outside->backs, 1.0);
    EXPECT_EQ(row.outside->rays, 0u);
    EXPECT_EQ(row_of(engine, 2).columns, std::vector<PatchIndex>{1}) << "nor is it seen";
}

}  // namespace
}  // namespace patchlight::hemicube_engine_test
