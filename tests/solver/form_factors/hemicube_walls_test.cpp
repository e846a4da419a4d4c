#include "solver/form_factors/hemicube_engine.h"
#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::hemicube_walls_test {
namespace {

const std::vector<int> resolutions{16, 63, 64, 65};

HemicubeEngine engine_of(const EngineScene& scene, int resolution) {
    HemicubeSettings settings;
    settings.resolution = resolution;
    return {scene.cut.scene, scene.cut.mesh, scene.rays, settings};
}

/// No patch on one side of the plane x = `parting` names one on the other.
void expect_parted(const EngineScene& scene, double parting) {
    const auto& patches = scene.cut.mesh.patches;
    const auto side = [&](PatchIndex i) {
        // Walls that stand in the plane itself belong where they look.
        const double x = patches[i].centre.x() - parting;
        const Vec3& normal = scene.cut.scene.surfaces[patches[i].surface].normal;
        return std::abs(normal.x()) > 0.5 && std::abs(x) < 0.01 ? normal.x() > 0.0 : x > 0.0;
    };
    for (const int resolution : resolutions) {
        const HemicubeEngine engine = engine_of(scene, resolution);
        for (PatchIndex i = 0; i < patches.size(); ++i) {
            const FactorRow row = row_of(engine, i);
            EXPECT_GT(row_sum(row), 0.99) << "closed rooms";
            for (const PatchIndex j : row.columns)
                ASSERT_EQ(side(i), side(j)) << i << " names " << j << " at " << resolution;
        }
    }
}

class WallsOf : public testing::TestWithParam<double> {};  // thickness [m]

TEST_P(WallsOf, AnyThicknessLetNoLightThrough) {
    Scene scene = room();
    add_box(scene, Vec3(1.0 + GetParam(), 0, 0), Vec3(2.0 + GetParam(), 1, 1), Facing::inwards);
    expect_parted(EngineScene(scene, 0.5), 1.0 + GetParam() / 2.0);
}

TEST_P(WallsOf, AnyThicknessLetNoLightThroughInATurnedScene) {
    Scene scene = room();
    add_box(scene, Vec3(1.0 + GetParam(), 0, 0), Vec3(2.0 + GetParam(), 1, 1), Facing::inwards);
    const EngineScene turned(moved(scene, {3.0, Vec3(40, -7, 12), odd_turn()}), 1.5);
    for (const int resolution : resolutions) {
        const HemicubeEngine engine = engine_of(turned, resolution);
        for (PatchIndex i = 0; i < turned.cut.mesh.size(); ++i)
            for (const PatchIndex j : row_of(engine, i).columns)
                ASSERT_EQ(turned.cut.mesh.patches[i].surface < 6,
                          turned.cut.mesh.patches[j].surface < 6)
                    << i << " names " << j << " at " << resolution;
    }
}

INSTANTIATE_TEST_SUITE_P(Walls, WallsOf, testing::Values(0.0, 1e-6, 1e-3, 0.05));

TEST(HemicubeWalls, ATwoSidedPartitionPartsARoom) {
    Scene scene = empty_scene();
    add_box(scene, Vec3::Zero(), Vec3(2, 1, 1), Facing::inwards);
    add(scene, rectangle(Vec3(0.97, 0, 0), Vec3::UnitY(), Vec3::UnitZ()), two_sided);
    expect_parted(EngineScene(scene, 0.5), 0.97);
}

/// Walls and floor run through from room to room, and the patch of a cell follows from where its
/// line of sight meets them, be it ever so little past the partition's edge: at these turns the
/// edge is at the border of a face, where a cell's neighbour is on another.
TEST(HemicubeWalls, APartitionsEdgeAtTheBorderOfAFaceLetsNoLightThrough) {
    Scene scene = empty_scene();
    add_box(scene, Vec3::Zero(), Vec3(2, 1, 1), Facing::inwards);
    add(scene, rectangle(Vec3(0.97, 0, 0), Vec3::UnitY(), Vec3::UnitZ()), two_sided);
    const EngineScene small(scene, 0.125);
    const PatchMesh& mesh = small.cut.mesh;
    const Vec3 beside_the_ceiling(0.672, 0.0, 0.969);
    PatchIndex i = mesh.first_of_surface[4];  // of the wall y = 0
    for (PatchIndex other = i; other < mesh.first_of_surface[5]; ++other)
        if ((mesh.patches[other].centre - beside_the_ceiling).norm() <
            (mesh.patches[i].centre - beside_the_ceiling).norm())
            i = other;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        HemicubeSettings settings;
        settings.resolution = 16;
        settings.seed = seed;
        const HemicubeEngine engine(small.cut.scene, mesh, small.rays, settings);
        for (const PatchIndex j : row_of(engine, i).columns)
            ASSERT_LT(mesh.patches[j].centre.x(), 0.97 + 1e-9) << "seed " << seed;
    }
}

class GapsOf : public testing::TestWithParam<double> {};  // share of the patch's edge

/// In the middle of a gap so narrow a patch sees nothing but the other.
TEST_P(GapsOf, AnyWidthAreSeenAcross) {
    const double gap = GetParam();
    const EngineScene pair(scene_of({rectangle(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()),
                                     rectangle(gap * Vec3::UnitZ(), Vec3::UnitY(), Vec3::UnitX())}),
                           9.0);
    for (const int resolution : resolutions)
        for (const PatchIndex i : {PatchIndex{0}, PatchIndex{1}}) {
            const FactorRow row = row_of(engine_of(pair, resolution), i);
            ASSERT_EQ(row.columns, std::vector<PatchIndex>{1u - i}) << resolution;
            EXPECT_GT(row.factors[0], 0.999) << resolution;
        }
}

INSTANTIATE_TEST_SUITE_P(Gaps, GapsOf, testing::Values(1e-3, 1e-4, 1e-5));

TEST(HemicubeGaps, OfSmallPatchesInALargeSceneAreSeenToo) {
    Scene scene = empty_scene();
    add_box(scene, Vec3(-5, -5, -5), Vec3(5, 5, 5), Facing::inwards);
    const double edge = 0.1, gap = 1e-3 * edge;
    add(scene, rectangle(Vec3::Zero(), edge * Vec3::UnitX(), edge * Vec3::UnitY()));
    add(scene, rectangle(gap * Vec3::UnitZ(), edge * Vec3::UnitY(), edge * Vec3::UnitX()));
    const EngineScene small(scene, 5.0);
    const PatchIndex lower = small.cut.mesh.first_of_surface[6];
    const FactorRow row = row_of(engine_of(small, 64), lower);
    ASSERT_EQ(row.columns.back(), lower + 1);
    EXPECT_GT(row.factors.back(), 0.99);
}

}  // namespace
}  // namespace patchlight::hemicube_walls_test
