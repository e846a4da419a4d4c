#include "solver/scene/input_error.h"
#include "tests/stability/furnace.h"
#include "tests/stability/judgement.h"

#include <algorithm>
#include <cmath>

namespace patchlight::stability::convergence_test {
namespace {

class Iterations : public EveryColumn {};

/// A closed cube in which everything reflects ρ and gives off 1 W/m².
Scene furnace(const Rgb& reflectance) {
    SceneBuilder builder;
    const MaterialIndex wall = builder.material(0.0, 1.0);
    builder.scene.materials[wall].reflectance = reflectance;
    builder.box("room", wall, {0, 0, 0}, {1, 1, 1}, true);
    return builder.scene;
}

TEST_P(Iterations, LightThatNeverDiesOutIsRefused) {
    for (const double beyond : {1.2, -0.1, std::nan("")})
        EXPECT_THROW(solve(furnace(Rgb::Constant(beyond)), GetParam()), InputError);
    judge_refused("B1", GetParam(), "never dies out",
                  [&] { solve(furnace(Rgb::Constant(1.0)), GetParam()); });
}

/// Rows of few rays sum to what they may: with 64 rays or cells the furnace burns at its level.
TEST_P(Iterations, RowsOfFewRaysDoNotMakeLight) {
    const double reflectance = 0.99;
    const Solution solution =
        solve(furnace(Rgb::Constant(reflectance)), GetParam(), {0.34, 64, 1e-6});
    constexpr double floats = 1e-4;  // of the matrix, over 1 - 0.99
    judge("B2", GetParam(), furnace_error(furnace(Rgb::Constant(reflectance)), solution, 100.0),
          floats);
}

/// How much larger the true error is than what is claimed.
TEST_P(Iterations, SlowConvergenceIsNotTakenForTheEnd) {
    const Scene scene = furnace(Rgb::Constant(0.999));
    const Solution solution = solve(scene, GetParam(), {0.5, 256, 1e-3});
    const auto& claim =
        GetParam().to_accuracy ? solution.error.estimate : solution.error.algebraic_bound;
    ASSERT_TRUE(claim.has_value());
    EXPECT_LE(*claim, default_accuracy);
    constexpr double floats = 2e-4;  // of the matrix, 6e-8 over 1 - 0.999, and of what closes it
    judge("B3", GetParam(), std::max(0.0, furnace_error(scene, solution, 1000.0) - *claim), floats);
}

TEST_P(Iterations, FaintAndBrightLightGiveTheSameRelativeAnswer) {
    const auto lit = [&](double exitance) {
        SceneBuilder builder;
        builder.box("room", builder.material(0.7, 0.0), {0, 0, 0}, {1, 1, 1}, true);
        builder.scene.surfaces[1].material = builder.material(0.2, exitance);
        return solve(builder.scene, GetParam(), {0.34, 256, 1e-4});
    };
    const Solution plain = lit(1.0);
    double worst = 0.0;
    for (const double exitance : {1e-6, 1e6}) {
        const Solution other = lit(exitance);
        ASSERT_EQ(other.mesh.size(), plain.mesh.size());
        for (PatchIndex i = 0; i < plain.mesh.size(); ++i)
            worst = std::max(
                worst, std::abs(other.radiosity[i][0] / exitance / plain.radiosity[i][0] - 1.0));
    }
    // The tolerance: rounding alone may break ties between patches of a shooter.
    judge("B4", GetParam(), worst, 1e-4);
}

TEST_P(Iterations, EachChannelConverges) {
    const Rgb reflectance(0.999, 0.5, 0.0);
    const Scene scene = furnace(reflectance);
    const Solution solution = solve(scene, GetParam(), {0.5, 256, 1e-4});
    const Rgb error = (solution.objects[0].radiosity * (1.0 - reflectance) - 1.0).abs();
    constexpr double bound_and_floats = 3e-4;
    judge("B10", GetParam(), error.maxCoeff(), bound_and_floats);
}

TEST_P(Iterations, ABlackRoomIsLitAndStaysBlack) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.0, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    builder.polygon("lamp", builder.material(0.0, 3.0),
                    {{0.3, 0.3, 0.9}, {0.3, 0.7, 0.9}, {0.7, 0.7, 0.9}, {0.7, 0.3, 0.9}});
    const Solution solution = solve(builder.scene, GetParam());
    EXPECT_GT(solution.objects[0].irradiance[0], 0.05) << "not B over reflectance";
    double worst = 0.0;
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i)
        worst = std::max(worst, std::abs(solution.radiosity[i][0] -
                                         3.0 * scene_object(builder.scene, solution, i)));
    judge("B11", GetParam(), worst, 0.0);
}

PATCHLIGHT_EVERY_COLUMN(Iterations);

}  // namespace
}  // namespace patchlight::stability::convergence_test
