#include "solver/factor_groups.h"
#include "solver/solve_scene.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::covered_area_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
constexpr double closed_form = 1e-6;  // exact factors leave rounding of stored floats

/// A furnace: every front gives off 1 and reflects half, so B = H = 2 wherever one looks.
Scene furnace() {
    Scene scene = empty_scene();
    scene.materials[white].exitance = Rgb::Ones();
    add_box(scene, Vec3::Zero(), Vec3(2, 2, 1), Facing::inwards);
    return scene;
}

Solution solved(const Scene& scene) {
    SolveSettings settings;
    settings.patch_size = 0.5;
    settings.rays = 16;
    settings.tolerance = 1e-7;
    settings.measure_error = false;
    return solve_scene(scene, settings, {});
}

void expect_furnace(const Scene& scene, const Solution& solution) {
    for (std::size_t k = 0; k < scene.objects.size(); ++k) {
        if (!(solution.objects[k].area > 0.0)) continue;
        EXPECT_NEAR(solution.objects[k].radiosity[0], 2.0, closed_form) << k;
        EXPECT_NEAR(solution.objects[k].irradiance[0], 2.0, closed_form) << k;
        EXPECT_NEAR(solution.objects[k].min[0], 2.0, 1e-4) << k;
    }
    EXPECT_LT(solution.energy.defect, closed_form);
    EXPECT_LT(solution.energy.backs[0], closed_form);
}

TEST(CoveredArea, HasNoWeightInMeans) {
    Scene scene = furnace();
    add(scene, rectangle(Vec3(0.5, 0.5, 0), x, y));  // on the floor
    add(scene, rectangle(Vec3(0.25, 1.5, 0), 1.5 * x, 0.4 * y));
    const Solution solution = solved(scene);
    expect_furnace(scene, solution);
    EXPECT_NEAR(solution.objects[0].area, 4.0 - 1.0 - 0.6, 1e-9);
    EXPECT_NEAR(solution.energy.emitted[0], 16.0, 1e-9);
}

TEST(CoveredArea, OfAFaceGivenTwiceCountsOnce) {
    Scene scene = furnace();
    const Surface floor = scene.surfaces[0];
    for (int copy = 0; copy < 3; ++copy) add(scene, floor.corners);
    const Solution solution = solved(scene);
    expect_furnace(scene, solution);
    EXPECT_EQ(solution.objects[0].area, 0.0);
    EXPECT_EQ(solution.objects[0].radiosity[0], 0.0);
    EXPECT_NEAR(solution.objects.back().area, 4.0, 1e-9);
}

TEST(CoveredArea, OfARugHalfOffTheFloorIsTheRest) {
    Scene scene = furnace();
    add(scene, rectangle(Vec3(1.5, 0.5, 0), x, y));
    const Solution solution = solved(scene);
    EXPECT_NEAR(solution.objects[0].area, 3.5, 1e-9);
    EXPECT_NEAR(solution.objects[0].irradiance[0], 2.0, closed_form);
}

TEST(CoveredArea, LeavesRowsOfObjectsClosed) {
    Scene scene = furnace();
    add(scene, rectangle(Vec3(0.5, 0.5, 0), x, y));
    const CutScene cut_scene = cut(scene, 0.5);
    const FactorGroups groups = make_factor_groups(scene, cut_scene.mesh, Grouping::object);
    EXPECT_NEAR(groups.areas[0], 3.0, 1e-9);
    EXPECT_NEAR(groups.areas[6], 1.0, 1e-9);
}

/// Every second of a heap of polygons on one plane peeps out.
TEST(CoveredArea, OfAHeapOfPolygonsIsRightAndCostsLittle) {
    Scene scene = furnace();
    constexpr int count = 40;
    for (int k = 0; k < count; ++k)
        add(scene, rectangle(Vec3(0.2 + 0.01 * k, 0.2 + 0.01 * k, 0), x, y));
    const CutScene cut_scene = cut(scene, 1.0);
    double area = 0.0;
    for (const Patch& patch : cut_scene.mesh.patches)
        if (!patch.covered) area += patch.area;
    EXPECT_NEAR(area, 16.0, 1e-8);
    EXPECT_LT(cut_scene.mesh.size(), 2000u);
}

}  // namespace
}  // namespace patchlight::covered_area_test
