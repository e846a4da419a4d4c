#include "tests/solver/form_factors/closed_forms.h"
#include "tests/stability/lit_pair.h"

#include <algorithm>
#include <cmath>

namespace patchlight::stability::reciprocity_test {
namespace {

constexpr double asked = 0.02;  // relative: the accuracy a solve has if nothing is said
constexpr int rays = 4096;
constexpr HandSet one_patch{4.0, rays, 1e-6};
constexpr double energy_kept = 1e-3;  // of the light emitted

class Reciprocity : public EveryColumn {};

/// An obstructor that stands on the edge two squares share hides some, and adds nothing.
TEST_P(Reciprocity, ABlockerAtTheEdgeNeverAddsLight) {
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    LitPair pair{parallelogram(Vec3::Zero(), x, y), parallelogram(Vec3::Zero(), y, z)};
    const double open = factor(pair, every_column()[0], one_patch);
    for (const double gap : {0.0, 1e-3}) {
        const Vec3 foot = gap * (x + z);
        pair.blockers.push_back(
            {foot, foot + 0.5 * y, foot + 0.5 * y + 0.3 * (x + z), foot + 0.3 * (x + z)});
        pair.blockers.push_back(
            {foot + 0.3 * (x + z), foot + 0.5 * y + 0.3 * (x + z), foot + 0.5 * y, foot});
    }
    SolveSettings settings = settings_for(GetParam(), one_patch);
    settings.time_limit = 1.0;  // to an accuracy it would take minutes: singular penumbrae
    const Solution blocked = patchlight::solve(scene_of(pair, 0.5), settings);
    const double gained = blocked.objects[0].radiosity[0] / 0.5 / open - 1.0;
    const double overfull = blocked.form_factors.repaired.row_sum_max - 1.0;
    EXPECT_LT(gained, -0.05) << "what blocks must show";
    constexpr double rounding = 1e-6;  // float entries
    judge("A7", GetParam(), std::max({gained, overfull, 0.0}), rounding);
}

/// Light on one of two squares while the other gives it off, a blocker between [W/m²].
double light_across(const Column& column, bool large_is_lit) {
    const LitPair squares = facing_squares(1.0, 0.3, 0.8);
    const double reflectance = column.to_accuracy ? 0.5 : 0.0;
    SceneBuilder builder;
    const MaterialIndex dark = builder.material(reflectance, 0.0), lit = builder.material(0.0, 1.0);
    builder.polygon("large", large_is_lit ? lit : dark, squares.receiver);
    builder.polygon("small", large_is_lit ? dark : lit, squares.lamp);
    builder.polygon("blocker", builder.material(0.0, 0.0),
                    {{0, -1, 0.4}, {2, -1, 0.4}, {2, 1, 0.4}, {0, 1, 0.4}});
    return solve(builder.scene, column, one_patch).objects[large_is_lit ? 1 : 0].irradiance[0];
}

TEST_P(Reciprocity, AsMuchLightGoesThereAsBack) {
    constexpr double small = 0.3 * 0.3;  // [m²]
    const double to_large = light_across(GetParam(), false),
                 to_small = light_across(GetParam(), true);
    Excuse excuse;
    if (GetParam().shoots())
        excuse = {
            3.0 * binomial(to_large, rays),
            "the shooter's row alone counts, and the other end's says something else: 1/√(nF)"};
    if (GetParam().to_accuracy)
        excuse = {default_accuracy, "each way is gathered on its own, within the accuracy asked"};
    judge("A8", GetParam(), std::abs(to_large / (to_small * small) - 1.0), energy_kept, excuse);
}

/// A unit lamp in the ceiling, tiny tiles in the floor: areas 1e6 to 1.
Scene lamp_over_tiles() {
    SceneBuilder builder;
    builder.box("room", builder.material(0.7, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    builder.scene.surfaces[1].material = builder.material(0.7, 1.0);
    const MaterialIndex dark = builder.material(0.2, 0.0);
    for (int k = 0; k < 8; ++k)
        builder.polygon("tile", dark,
                        parallelogram({0.1 + 0.1 * k, 0.4, 0}, {1e-3, 0, 0}, {0, 1e-3, 0}));
    return builder.scene;
}

TEST_P(Reciprocity, TinyPatchesNeitherLoseNorMakeLight) {
    const Solution solution = solve(lamp_over_tiles(), GetParam());
    const Excuse excuse = GetParam().to_accuracy
                              ? Excuse{default_accuracy, "means of a field gathered point by point"}
                              : Excuse{};
    judge("B5", GetParam(), solution.energy.defect, energy_kept, excuse);
}

TEST_P(Reciprocity, NoTinyPatchReceivesMoreThanThereIs) {
    // All radiosities are below 1 / (1 - 0.7), and so is what any patch can receive.
    constexpr double most = 1.0 / (1.0 - 0.7);
    const Solution solution = solve(lamp_over_tiles(), GetParam());
    double worst = 0.0;
    for (const Rgb& irradiance : solution.irradiance)
        worst = std::max(worst, irradiance[0] / most - 1.0);
    judge("B6", GetParam(), worst, asked);
}

TEST_P(Reciprocity, AFlatSurfaceDoesNotSeeItself) {
    SceneBuilder builder;
    builder.polygon("lamp", builder.material(0.9, 1.0),
                    {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
    const Solution solution = solve(builder.scene, GetParam());
    double most = 0.0;
    for (const Rgb& irradiance : solution.irradiance) most = std::max(most, irradiance[0]);
    for (const Rgb& radiosity : solution.radiosity) EXPECT_EQ(radiosity[0], 1.0);
    judge("B12", GetParam(), most, 0.0);
}

PATCHLIGHT_EVERY_COLUMN(Reciprocity);

}  // namespace
}  // namespace patchlight::stability::reciprocity_test
