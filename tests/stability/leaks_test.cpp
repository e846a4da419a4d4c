#include "tests/stability/furnace.h"
#include "tests/stability/lit_pair.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight::stability::leaks_test {
namespace {

class Leaks : public EveryColumn {};

void add_lamp(SceneBuilder& builder) {
    builder.polygon("lamp", builder.material(0.2, 10.0),
                    {{0.3, 0.3, 1}, {0.3, 0.7, 1}, {0.6, 0.7, 1}, {0.6, 0.3, 1}});
}

/// Most light on patches and in the picture of what lies beyond x.
double most_beyond(double x, const Solution& solution) {
    const auto is_beyond = [&](PatchIndex i) { return solution.mesh.patches[i].centre.x() > x; };
    double most = 0.0;
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i)
        if (is_beyond(i)) most = std::max(most, solution.radiosity[i].maxCoeff());
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t)
        if (is_beyond(solution.display.patch[t]))
            for (const std::uint32_t v : solution.display.triangles[t])
                most = std::max(most, solution.display.radiosity[v].maxCoeff());
    return most;
}

TEST_P(Leaks, TheSecondOfTwoRoomsStaysDark) {
    double most = 0.0;
    for (const double thickness : {0.0, 1e-6, -1e-3}) {
        SceneBuilder builder;
        const MaterialIndex wall = builder.material(0.8, 0.0);
        builder.box("lit", wall, {0, 0, 0}, {1, 1, 1}, true);
        add_lamp(builder);
        constexpr int low_x = 4;
        const double x = 1.0 + thickness;
        builder.box("dark", wall, {x, 0, 0}, {x + 1, 1, 1}, true, Eigen::Isometry3d::Identity(),
                    low_x);
        for (int i = 0; i < 3; ++i)  // T-junctions with the wall on the other side
            for (int j = 0; j < 2; ++j)
                builder.polygon("dark tile", wall,
                                parallelogram({x, i / 3.0, j / 2.0}, {0, 1 / 3.0, 0}, {0, 0, 0.5}));
        const SolveSettings settings = settings_for(GetParam(), {0.5, 256, 1e-4});
        most = std::max(
            most, most_beyond(std::max(x, 1.0) + 1e-9, patchlight::solve(builder.scene, settings)));
    }
    judge("C1", GetParam(), most, 0.0);
}

/// Half a room that is lit, half that is not, on one floor; what parts them is of no thickness.
Scene parted_room() {
    SceneBuilder builder;
    const MaterialIndex wall = builder.material(0.8, 0.0);
    builder.box("shell", wall, {0, 0, 0}, {2, 1, 1}, true);
    const Corners parting{{0.97, 0, 0}, {0.97, 1, 0}, {0.97, 1, 1}, {0.97, 0, 1}};
    builder.polygon("dark side", wall, parting);
    builder.polygon("lit side", wall, Corners(parting.rbegin(), parting.rend()));
    add_lamp(builder);
    return builder.scene;
}

TEST_P(Leaks, NoLightCrossesTwoQuadsBackToBackNorShowsAtTheirFoot) {
    const Scene scene = parted_room();
    const Solution solution = solve(scene, GetParam(), {0.3, 256, 1e-4});
    EXPECT_GT(solution.objects[2].radiosity[0], 0.1) << "the lit side";
    judge("C13", GetParam(), solution.objects[1].radiosity[0], 0.0);
    judge("D3", GetParam(), most_beyond(0.97 + 1e-9, solution), 0.0);
}

TEST_P(Leaks, TheFloorRoundABoxShowsNoShadowOfItsHiddenPart) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.5, 1.0);
    builder.box("room", grey, {0, 0, 0}, {1, 1, 1}, true);
    const Vec3 low(0.35, 0.3, 0), high(0.7, 0.6, 0.5);
    builder.box("box", grey, low, high, false);
    const Solution solution = solve(builder.scene, GetParam(), {0.25, 256, 1e-6});
    double worst = 0.0;
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t) {
        const Patch& patch = solution.mesh.patches[solution.display.patch[t]];
        const Eigen::AlignedBox3d box(low, high);
        if (patch.surface != 0 || box.contains(patch.centre)) continue;  // the floor beside the box
        for (const std::uint32_t v : solution.display.triangles[t])
            worst = std::max(worst, std::abs(solution.display.radiosity[v][0] / 2.0 - 1.0));
    }
    Excuse excuse = one_ended_rows(GetParam(), 1.0 / 96.0, 256);
    if (GetParam().to_accuracy) excuse = {3.0 * default_accuracy, "noise of gathering at vertices"};
    judge("C2", GetParam(), worst, furnace_closure, excuse);
}

PATCHLIGHT_EVERY_COLUMN(Leaks);

}  // namespace
}  // namespace patchlight::stability::leaks_test
