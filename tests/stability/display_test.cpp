#include "tests/stability/display_field.h"
#include "tests/stability/lit_pair.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight::stability::display_test {
namespace {

constexpr double asked = 0.02;  // the accuracy a solve has if nothing is said
constexpr HandSet coarse{0.25, 1024, 1e-6};

class Display : public EveryColumn {};

TEST_P(Display, IsContinuousAcrossTJunctions) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.5, 0.0);
    builder.scene.objects.push_back({"floor"});
    const double border = 0.3;
    add_polygon(builder.scene, 0, grey, 0, parallelogram({0, 0, 0}, {border, 0, 0}, {0, 1, 0}), "");
    for (int k = 0; k < 3; ++k)  // three beside one: their corners are T-junctions
        add_polygon(builder.scene, 0, grey, 1,
                    parallelogram({border, k / 3.0, 0}, {1 - border, 0, 0}, {0, 1 / 3.0, 0}), "");
    builder.polygon("lamp", builder.material(0.0, 1.0),
                    parallelogram({0.1, 0.2, 0.6}, {0, 0.5, 0}, {0.5, 0, 0}));
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    double jump = 0.0, most = 0.0;
    for (double y = 0.013; y < 1.0; y += 0.037) {
        const Vec3 point(border, y, 0);
        const auto left = shown_at(solution, 0, point);
        const auto right = shown_at(solution, static_cast<SurfaceIndex>(1 + 3.0 * y), point);
        ASSERT_TRUE(left && right) << "a crack at y = " << y;
        jump = std::max(jump, std::abs(*left - *right));
        most = std::max(most, *left);
    }
    ASSERT_GT(most, 0.0);
    Excuse excuse;
    if (!GetParam().to_accuracy)
        excuse = {0.25,
                  "patches of either side are interpolated on their own points: second order "
                  "in the patch size, and the noise of rows"};
    judge("D1", GetParam(), jump / most, asked, excuse);
}

TEST_P(Display, ShowsAPenumbra) {
    const nlohmann::json entry = reference_case("solutions.json", "s-d12");
    SceneBuilder builder;
    builder.polygon("floor", builder.material(0.5, 0.0),
                    parallelogram({-1.25, -1.25, 0}, {2.5, 0, 0}, {0, 2.5, 0}));
    builder.polygon("lamp", builder.material(0.0, 1.0), points_of(entry["light"]));
    builder.polygon("blocker", builder.material(0.0, 0.0), points_of(entry["occluder"]));
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    double worst = 0.0;
    for (const auto& point : entry["points"]) {
        const auto shown = shown_at(solution, 0, {point["x"].get<double>(), 0, 0});
        ASSERT_TRUE(shown);
        worst = std::max(worst, std::abs(*shown / 0.5 - point["visible_F"].get<double>()));
    }
    const double unshadowed = entry["points"][0]["unoccluded_F"].get<double>();
    Excuse excuse{2.0 * asked, "an accuracy is a mean over all that is lit, no bound at a point"};
    if (!GetParam().to_accuracy)
        excuse = {GetParam().shoots() && GetParam().counts() ? 1.0 : 0.25,
                  "linear between means of patches of 0.25 in a penumbra 1 wide, and the noise of "
                  "rows: first order where shadows begin"};
    judge("D2", GetParam(), worst / unshadowed, asked, excuse);
}

TEST_P(Display, NeitherUndershootsNorOvershootsNorMixesPaints) {
    SceneBuilder builder;
    builder.polygon("white", builder.material(0.8, 0.0),
                    parallelogram({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    builder.polygon("black", builder.material(0.0, 0.0),
                    parallelogram({1, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    builder.polygon("lamp", builder.material(0.0, 1.0),
                    parallelogram({0.8, 0.4, 0.1}, {0, 0.2, 0}, {0.2, 0, 0}));
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    const double most = 0.8;  // of what the lamp can send
    const double beyond = std::max({-solution.objects[0].min[0], solution.objects[0].max[0] - most,
                                    solution.objects[1].max[0], 0.0});
    judge("D4", GetParam(), beyond, 0.0);
}

TEST_P(Display, KeepsPlanesApartAtCreases) {
    SceneBuilder builder;
    const MaterialIndex black = builder.material(0.0, 0.0);
    builder.box("room", black, {0, 0, 0}, {1, 1, 1}, true);
    builder.scene.surfaces[0].material = builder.material(0.0, 1.0);
    builder.polygon("what reflects", builder.material(0.5, 0.0),
                    parallelogram({0.4, 0.4, 0.5}, {0, 0.2, 0}, {0.2, 0, 0}));
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    double worst = 0.0;
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t) {
        const SurfaceIndex s = solution.mesh.patches[solution.display.patch[t]].surface;
        if (s > 5) continue;
        for (const std::uint32_t v : solution.display.triangles[t])
            worst = std::max(worst, std::abs(solution.display.radiosity[v][0] - (s == 0 ? 1 : 0)));
    }
    judge("D5", GetParam(), worst, 0.0);
}

TEST_P(Display, LampsNarrowerThanPatchesKeepTheirArea) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.5, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    builder.polygon("strip", builder.material(0.0, 2.0),
                    parallelogram({0.4, 0.05, 1}, {0, 0.9, 0}, {0.125, 0, 0}));
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    constexpr double rounding = 1e-12;
    const double area = 0.9 * 0.125;
    judge("D6", GetParam(),
          std::max(std::abs(solution.objects[1].area / area - 1.0),
                   std::abs(solution.energy.emitted[0] / (2.0 * area) - 1.0)),
          rounding);
}

/// Flux by objects, by patches and in the picture.
TEST_P(Display, CarriesTheFluxOfItsPatches) {
    SceneBuilder builder;
    builder.polygon("floor", builder.material(0.5, 0.0),
                    {{0, 0, 0}, {2, 0, 0}, {2, 0.7, 0}, {0.8, 0.7, 0}, {0.8, 1.5, 0}, {0, 1.5, 0}});
    builder.polygon("lamp", builder.material(0.0, 1.0),
                    parallelogram({0.1, 0.2, 0.8}, {0, 0.5, 0}, {0.5, 0, 0}));
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    double by_patches = 0.0, shown = 0.0;
    for (PatchIndex i = 0; i < solution.mesh.first_of_surface[1]; ++i)
        by_patches += solution.mesh.patches[i].area * solution.radiosity[i][0];
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t) {
        if (scene_object(builder.scene, solution, solution.display.patch[t]) != 0) continue;
        const auto& [a, b, c] = solution.display.triangles[t];
        const auto& p = solution.display.positions;
        for (const std::uint32_t v : {a, b, c})
            shown +=
                (p[b] - p[a]).cross(p[c] - p[a]).norm() / 6.0 * solution.display.radiosity[v][0];
    }
    const double by_object = solution.objects[0].area * solution.objects[0].radiosity[0];
    EXPECT_NEAR(by_patches / by_object, 1.0, 1e-12);
    judge("B9", GetParam(), std::abs(shown / by_patches - 1.0), asked);
}

PATCHLIGHT_EVERY_COLUMN(Display);

}  // namespace
}  // namespace patchlight::stability::display_test
