#include "solver/accuracy/judge.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight {
namespace {

constexpr double rounding = 1e-12;
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

TEST(MeasureReflected, TellsNormsOfObjectsAndHowOftenLightIsSentBack) {
    Scene scene = scene_of(rectangle(Vec3::Zero(), 2 * x, y));
    add(scene, rectangle({0, 0, 3}, x, y));
    const CutScene pieces = cut(scene, 9.0);
    ASSERT_EQ(pieces.mesh.size(), 2u);
    const std::vector<Rgb> reflected{Rgb::Constant(3.0), Rgb::Constant(1.0)},
        once{Rgb::Constant(4.0), Rgb::Zero()};  // irradiance; reflectance is 0.5
    const ReflectedLight light = measure_reflected(pieces.scene, pieces.mesh, reflected, once);
    EXPECT_NEAR(light.area, 3.0, rounding);
    EXPECT_NEAR(light.norm_of_object[0], 3.0 * std::sqrt(2.0), rounding);
    EXPECT_NEAR(light.norm_of_object[1], 1.0, rounding);
    EXPECT_NEAR(light.norm, std::sqrt(19.0), rounding);
    EXPECT_NEAR(light.bounces, (2.0 * 3.0 + 1.0) / (2.0 * 2.0), rounding);
}

struct Judged {
    CheckReport checks;
    ReflectedLight light;
    ErrorReport error;

    Judged() {
        checks.direct = {0.03, 0.0, 0.0, 400};
        checks.indirect = {0.01, 0.0, 0.0, 400};
        light = {2.0, 4.0, 3.0, {1.9, 0.6, 0.01}};
        checks.of_object = {{0.01, 500}, {0.01, 300}, {0.5, 100}};
    }
};

TEST(EstimateError, TakesWhatWasMeasuredBesideTheNorm) {
    Judged judged;
    estimate_error(judged.checks, judged.light, 0.0, 0.0, judged.error);
    EXPECT_NEAR(*judged.error.mesh, passed_on * 0.2 / 2.0, rounding);
    EXPECT_NEAR(*judged.error.estimate, *judged.error.mesh, rounding);
    ASSERT_TRUE(judged.error.worst);
    EXPECT_EQ(judged.error.worst->object, 1u) << "the third hardly sends back any light";
    EXPECT_NEAR(judged.error.worst->estimate, 0.1 / 0.6, rounding);
}

TEST(EstimateError, GrowsByDoubtAndByWhatIsWrongEverywhereAlike) {
    Judged judged;
    judged.checks.indirect.variance = 1e-4;
    estimate_error(judged.checks, judged.light, 0.0, sure, judged.error);
    EXPECT_NEAR(*judged.error.mesh, passed_on * std::sqrt(0.04 + 2 * 0.01) / 2.0, rounding);
    judged.checks.indirect.mean = -0.2;
    judged.error.algebraic_bound = 0.001;
    estimate_error(judged.checks, judged.light, 0.03, sure, judged.error);
    const double alike = (3.0 - 1.0) * 0.2 / std::sqrt(4.0) / 2.0;
    EXPECT_NEAR(*judged.error.form_factors, std::hypot(0.03, alike), rounding);
    EXPECT_NEAR(*judged.error.estimate,
                0.001 + std::hypot(*judged.error.form_factors, *judged.error.mesh), rounding);
}

TEST(EstimateError, SaysNothingWhereNoLightIsSentBack) {
    Judged judged;
    judged.light.norm = 0.0;
    estimate_error(judged.checks, judged.light, 0.0, sure, judged.error);
    EXPECT_FALSE(judged.error.estimate);
}

}  // namespace
}  // namespace patchlight
