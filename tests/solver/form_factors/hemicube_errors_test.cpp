#include "solver/form_factors/hemicube_errors.h"

#include "tests/slope.h"
#include "tests/solver/form_factors/closed_forms.h"
#include "tests/solver/form_factors/engine_scene.h"

#include <gtest/gtest.h>

namespace patchlight::hemicube_errors_test {
namespace {

HemicubeErrors errors_of(const EngineScene& scene, int resolution, int sub_samples) {
    HemicubeSettings settings;
    settings.resolution = resolution;
    settings.sub_samples = sub_samples;
    return *estimate_hemicube_errors(scene.cut.scene, scene.cut.mesh, scene.rays, settings);
}

/// Half of what the two entries are off is light that goes to the wrong patch.
TEST(HemicubeErrors, OfTwoCloseSquaresAreProximityAlone) {
    const EngineScene squares(facing_squares(), 9.0);
    const double exact = parallel_rectangles(1, 1, 1), centre = 0.23945647046077356;  // s-d15
    const HemicubeErrors errors = errors_of(squares, 256, 1);
    EXPECT_NEAR(errors.proximity, 0.5 * (centre - exact), 1e-6);
    EXPECT_LT(errors.aliasing, 0.05 * errors.proximity);
    EXPECT_EQ(errors.visibility, 0.0) << "nothing hides anything";
}

TEST(HemicubeErrors, OfProximityFallAsPartsGrowInNumber) {
    const EngineScene squares(facing_squares(), 9.0);
    const double one = errors_of(squares, 128, 1).proximity,
                 two = errors_of(squares, 128, 2).proximity,
                 four = errors_of(squares, 128, 4).proximity;
    EXPECT_NEAR(one / two, 4.9, 0.2) << "s-d15";
    EXPECT_NEAR(two / four, 4.2, 0.2);
}

/// A plate close over half of a square hides the other square from that half; the centre of the
/// first sees it whole, so that half of its factor is wrong.
TEST(HemicubeErrors, OfAHalfHiddenPairAreVisibility) {
    Scene scene = scene_of({rectangle({-0.5, -0.5, 0}, Vec3::UnitX(), Vec3::UnitY()),
                            rectangle({-0.5, -0.5, 8}, Vec3::UnitY(), Vec3::UnitX())});
    add(scene, rectangle({0.01, -0.6, 0.05}, 0.6 * Vec3::UnitX(), 1.2 * Vec3::UnitY()));
    const EngineScene half(scene, 99.0);
    const HemicubeErrors errors = errors_of(half, 512, 1);
    EXPECT_GT(errors.visibility, 4.0 * errors.proximity);
    EXPECT_GT(errors.visibility, 4.0 * errors.aliasing);
    EXPECT_LT(errors_of(half, 512, 4).visibility, 0.5 * errors.visibility);
}

TEST(HemicubeErrors, OfAliasingFallWithTheResolution) {
    const EngineScene closed(room(), 0.25);
    std::vector<double> resolutions, aliasing;
    for (const int resolution : {32, 64, 128, 256}) {
        resolutions.push_back(resolution);
        aliasing.push_back(errors_of(closed, resolution, 1).aliasing);
    }
    EXPECT_EQ(errors_of(closed, 64, 0).visibility, 0.0) << "nothing hides anything in a room";
    const Slope slope = fit_slope(resolutions, aliasing);
    RecordProperty("slope", std::to_string(slope.value));
    EXPECT_LT(slope.value, -0.9) << "-1 for walls, -3/2 for what faces the patch";
    EXPECT_GT(slope.value, -1.8);
}

TEST(HemicubeErrors, AreTheSameBytesEachTime) {
    const EngineScene closed(room_with_box(), 0.3);
    const HemicubeErrors once = errors_of(closed, 32, 0), again = errors_of(closed, 32, 0);
    EXPECT_EQ(once.proximity, again.proximity);
    EXPECT_EQ(once.visibility, again.visibility);
    EXPECT_EQ(once.aliasing, again.aliasing);
}

}  // namespace
}  // namespace patchlight::hemicube_errors_test
