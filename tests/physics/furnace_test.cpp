#include "tests/physics/rooms.h"

#include <cmath>

namespace patchlight::furnace_test {

namespace {

constexpr double closure =
    1e-5;  // relative: float factors (6e-8) amplified by 1/(1 − ρ), and the solver's 1e-8

/// Where cells do not see what is behind an edge, the rest of a row may meet its ceilings before it
/// is full: 32 x 32 cells leave 6e-5 of one row in 3 x 222 open (seeds 1 to 3).
constexpr double open_hemicube = 2e-4;

constexpr int rays_per_patch = 1024;
/// Shooting spreads light by rows of one end of each pair, as they come: nothing is lost, but a
/// patch gets as much as happens to hit it. Root mean square over patches, relative: independent
/// rays would scatter by 1 / sqrt(1024) = 0.031; hemicubes of 32 x 32 cells by less.
constexpr double counted_scatter = 0.035;
/// Analytic rows scatter only where something blocks.
constexpr double blocked_scatter = 0.01;

double scatter_of(const Way& way, bool blocked) {
    if (way.method != Method::shooting)
        return blocked && way.engine == Engine::hemicube ? open_hemicube : closure;
    if (way.engine == Engine::analytic) return blocked ? blocked_scatter : closure;
    return counted_scatter;
}

/// Where all surfaces reflect ρ and give off E, B = E / (1 − ρ) on every patch that is not walled
/// in.
void expect_furnace(const Scene& scene, const Way& way, double reflectance, double exitance,
                    bool blocked = true) {
    SolveSettings settings = settings_of(way);
    settings.patch_size = 0.2;
    set_rays(settings, rays_per_patch);
    const Solution solution = solve(scene, settings);
    ASSERT_TRUE(solution.within_tolerance);
    const double exact = exitance / (1.0 - reflectance);
    const double scatter = reflectance > 0.0 ? scatter_of(way, blocked) : closure;
    double area = 0.0, power = 0.0, squared = 0.0;
    std::size_t seen = 0;
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        // Under an obstacle a patch sees backs alone.
        if (solution.irradiance[i][0] < 0.5 * exact) continue;
        ++seen;
        const double a = solution.mesh.patches[i].area, b = solution.radiosity[i][0];
        area += a;
        power += a * b;
        squared += a * std::pow(b / exact - 1.0, 2);
        if (scatter == closure || scatter == open_hemicube) {
            ASSERT_NEAR(b, exact, scatter * exact) << "patch " << i;
        }
    }
    EXPECT_GT(seen, solution.mesh.size() * 9 / 10);
    EXPECT_LT(std::sqrt(squared / area), scatter);
    EXPECT_NEAR(power / area, exact, std::max(closure, 0.01 * scatter) * exact);
    EXPECT_LT(solution.energy.defect, 1e-4);
    EXPECT_LT(solution.form_factors.repaired.closure_max, 1e-6);
}

Eigen::Isometry3d turned(double x, double y, double z) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(Vec3(0.1, -0.2, 0.05));
    pose.rotate(Eigen::AngleAxisd(x, Vec3::UnitX()) * Eigen::AngleAxisd(y, Vec3::UnitY()) *
                Eigen::AngleAxisd(z, Vec3::UnitZ()));
    return pose;
}

}  // namespace

class Furnace : public EveryEngineAndMethod {};

TEST_P(Furnace, ReachesExitanceOverAbsorptance) {
    for (const double reflectance : {0.0, 0.1, 0.5, 0.9, 0.99}) {
        SceneBuilder builder;
        builder.box("room", builder.material(reflectance, 1.0), {0, 0, 0}, {1, 1, 1}, true);
        expect_furnace(builder.scene, GetParam(), reflectance, 1.0, false);
    }
}

TEST_P(Furnace, HoldsInATurnedRoomOfAnyShape) {
    SceneBuilder builder;
    const MaterialIndex wall = builder.material(0.8, 2.0);
    const Eigen::Isometry3d pose = turned(0.3, 0.7, 1.1);
    const std::vector<Vec3> outline{{0, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                    {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};  // an L
    std::vector<Vec3> floor, ceiling;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec3 a = outline[k], b = outline[(k + 1) % outline.size()], up(0, 0, 1);
        floor.push_back(pose * a);
        ceiling.insert(ceiling.begin(), pose * Vec3(a + up));
        builder.polygon("wall", wall,
                        {pose * a, pose * Vec3(a + up), pose * Vec3(b + up), pose * b});
    }
    builder.polygon("floor", wall, floor);
    builder.polygon("ceiling", wall, ceiling);
    expect_furnace(builder.scene, GetParam(), 0.8, 2.0);
}

TEST_P(Furnace, HoldsRoundAFloatingBox) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.8, 1.0);
    builder.box("room", grey, {0, 0, 0}, {1, 1, 1}, true);
    builder.box("float", grey, {-0.2, -0.15, -0.1}, {0.2, 0.15, 0.1}, false,
                Eigen::Translation3d(0.5, 0.6, 0.5) * turned(0.2, 0.4, 0.6));
    expect_furnace(builder.scene, GetParam(), 0.8, 1.0);
}

TEST_P(Furnace, HoldsRoundAStandingBoxWithAndWithoutBottom) {
    for (const int skipped : {-1, 0}) {
        SceneBuilder builder;
        const MaterialIndex grey = builder.material(0.8, 1.0);
        builder.box("room", grey, {0, 0, 0}, {1, 1, 1}, true);
        const Eigen::Isometry3d pose(Eigen::Translation3d(0.5, 0.45, 0.0) *
                                     Eigen::AngleAxisd(0.35, Vec3::UnitZ()));
        builder.box("stand", grey, {-0.2, -0.15, 0}, {0.2, 0.15, 0.5}, false, pose, skipped);
        expect_furnace(builder.scene, GetParam(), 0.8, 1.0);
    }
}

TEST_P(Furnace, HoldsOnBothSidesOfAPartition) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.8, 1.0);
    builder.box("room", grey, {0, 0, 0}, {1, 1, 1}, true);
    MaterialIndex both = builder.material(0.8, 1.0);
    builder.scene.materials[both].two_sided = true;
    builder.polygon("partition", both,
                    {{0.43, 0, 0}, {0.43, 0.7, 0}, {0.43, 0.7, 0.8}, {0.43, 0, 0.8}});
    expect_furnace(builder.scene, GetParam(), 0.8, 1.0);
}

INSTANTIATE_TEST_SUITE_P(EveryWay, Furnace, testing::ValuesIn(every_way()), way_name);

}  // namespace patchlight::furnace_test
