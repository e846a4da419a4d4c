#include "tests/stability/furnace.h"
#include "tests/stability/lit_pair.h"

#include <algorithm>
#include <cmath>

namespace patchlight::stability::odd_geometry_test {
namespace {

constexpr double asked = 0.02;        // relative: the accuracy a solve has if nothing is said
constexpr double energy_kept = 1e-3;  // of the light emitted
constexpr HandSet coarse{0.34, 256, 1e-6};

class OddGeometry : public EveryColumn {};

bool tells(const Solution& solution, const std::string& kind) {
    return std::any_of(solution.findings.begin(), solution.findings.end(),
                       [&](const Finding& finding) { return finding.kind == kind; });
}

/// A solve to an accuracy accounts for light by means of a field it gathered point by point.
Excuse gathered(const Column& column) {
    if (!column.to_accuracy) return {};
    return {default_accuracy, "the field is gathered point by point, within the accuracy asked"};
}

TEST_P(OddGeometry, ALampInThePlaneOfTheCeilingShinesInFull) {
    LitPair pair = facing_squares(1.0, 0.5, 1.0);
    const double alone = factor(pair, every_column()[0], coarse);
    SceneBuilder builder;
    const double reflectance = GetParam().to_accuracy ? 0.5 : 0.0;
    builder.polygon("floor", builder.material(reflectance, 0.0), pair.receiver);
    builder.polygon("ceiling", builder.material(0.0, 0.0), facing_squares(1.0, 1.0, 1.0).lamp);
    builder.polygon("lamp", builder.material(0.0, 1.0), pair.lamp);
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    EXPECT_FALSE(tells(solution, "coplanar-overlap"));  // it is meant so
    EXPECT_NEAR(solution.energy.emitted[0], 0.25, 1e-12);
    Excuse excuse;
    if (GetParam().counts())
        excuse = {2.0 * binomial(0.26, 4 * coarse.rays),
                  "counts that hit are binomial: 1/√(nF) of the rays of the lamp's four patches"};
    judge("C4", GetParam(), std::abs(solution.objects[0].irradiance[0] / alone - 1.0), asked,
          excuse);
}

TEST_P(OddGeometry, AnInvertedWallShowsInTheEnergyBalance) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.5, 1.0), {0, 0, 0}, {1, 1, 1}, true);
    Surface& flipped = builder.scene.surfaces[3];
    std::reverse(flipped.corners.begin(), flipped.corners.end());
    flipped.normal = -flipped.normal;
    const EnergyReport energy = solve(builder.scene, GetParam(), coarse).energy;
    EXPECT_GT(energy.backs[0], 0.1 * energy.emitted[0]);
    // By rays where a solve to an accuracy counts them: 4 standard errors, 1 in 16 000.
    EXPECT_NEAR(energy.escaped[0], 1.0, 1e-3 + 4.0 * energy.standard_error * energy.emitted[0])
        << "all that the wall gives off";
    judge("C5", GetParam(), energy.defect, energy_kept, gathered(GetParam()));
}

TEST_P(OddGeometry, LightThatLeavesAnOpenBoxIsAccountedFor) {
    const Solution solution = solve(cornell_like(true), GetParam(), {0.15, 512, 1e-4});
    EXPECT_GT(solution.energy.escaped[0], 0.1 * solution.energy.emitted[0]);
    EXPECT_TRUE(solution.form_factors.open);
    EXPECT_LE(solution.form_factors.repaired.row_sum_max, 1.0 + 1e-6);
    judge("C6", GetParam(), solution.energy.defect, energy_kept, gathered(GetParam()));
}

TEST_P(OddGeometry, TrianglesWithoutAreaAreDroppedAndCounted) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.5, 1.0);
    builder.box("room", grey, {0, 0, 0}, {1, 1, 1}, true);
    builder.polygon("line", grey, {{0.2, 0.2, 0.5}, {0.4, 0.4, 0.5}, {0.6, 0.6, 0.5}});
    builder.polygon("point", grey, {{0.2, 0.2, 0.5}, {0.2, 0.2, 0.5}, {0.2, 0.2, 0.5}});
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    EXPECT_TRUE(tells(solution, "degenerate-dropped"));
    judge("C7", GetParam(), furnace_error(builder.scene, solution, 2.0), furnace_closure);
}

TEST_P(OddGeometry, ASceneWithoutALampSaysSo) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.5, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    EXPECT_TRUE(tells(solution, "no-emitter"));
    double most = 0.0;
    for (const Rgb& radiosity : solution.radiosity) most = std::max(most, radiosity.maxCoeff());
    judge("C11", GetParam(), most, 0.0);
}

TEST_P(OddGeometry, MorePatchesThanMemoryHoldsAreRefusedBeforehand) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.5, 1.0), {0, 0, 0}, {1, 1, 1}, true);
    SolveSettings settings = settings_for(GetParam(), {1e-5, 1024, 1e-6});
    if (GetParam().to_accuracy) settings.memory_limit = 1'000'000;
    judge_refused("C12", GetParam(), "memory limit is",
                  [&] { patchlight::solve(builder.scene, settings); });
}

PATCHLIGHT_EVERY_COLUMN(OddGeometry);

}  // namespace
}  // namespace patchlight::stability::odd_geometry_test
