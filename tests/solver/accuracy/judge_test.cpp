#include "solver/accuracy/judge.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::judge_test {
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

/// ∫ x² over the unit square is 1/3, where the mean would say 1/4.
TEST(DisplayedNorms, CountASlopeForWhatItIs) {
    const CutScene pieces = cut(scene_of(rectangle(Vec3::Zero(), x, y)), 9.0);
    TreeDisplay shown;
    shown.display.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    shown.display.triangles = {{0, 1, 2}, {0, 2, 3}};
    shown.display.patch = {0, 0};
    for (const double at : {0.0, 1.0, 1.0, 0.0}) {
        shown.arriving.direct.push_back(Rgb::Constant(0.5 * at));
        shown.arriving.indirect.push_back(Rgb::Constant(1.5 * at));
    }  // reflectance is 0.5
    const std::vector<double> norms = displayed_norms(pieces.scene, pieces.mesh, shown);
    EXPECT_NEAR(norms.at(0), std::sqrt(1.0 / 3.0), rounding);
}

struct Judged {
    CheckReport checks;
    Evidence evidence;

    Judged() {
        checks.direct = {0.03, 0.0, 0.0, 400};
        checks.indirect = {0.01, 0.0, 0.0, 400};
        checks.of_object = {{0.01, 0.0, 500}, {0.01, 0.0, 300}, {0.5, 0.0, 4}};
        evidence.checks = &checks;
        evidence.target = 0.2;
        evidence.light = {2.0, 4.0, 3.0, {1.9, 0.6, 0.01}};
    }
};

TEST(Judge, TakesWhatWasMeasuredBesideTheNorm) {
    Judged judged;
    const ErrorReport error = judge(judged.evidence, 0.0);
    EXPECT_NEAR(*error.mesh, passed_on * 0.2 / 2.0, rounding);
    EXPECT_NEAR(*error.estimate, *error.mesh, rounding);
    EXPECT_TRUE(error.met());
}

TEST(Judge, NamesTheObjectMostWrongBesideItsOwnLight) {
    Judged judged;
    const ErrorReport error = judge(judged.evidence, 0.0);
    ASSERT_TRUE(error.worst);
    EXPECT_EQ(error.worst->object, 1u);
    EXPECT_NEAR(error.worst->estimate, passed_on * 0.1 / 0.6, rounding);
    EXPECT_FALSE(error.of_object[2]) << "four points do not tell";
}

TEST(Judge, GrowsByDoubtAndByWhatIsWrongEverywhereAlike) {
    Judged judged;
    judged.checks.indirect.variance = 1e-4;
    EXPECT_NEAR(*judge(judged.evidence).mesh, passed_on * std::sqrt(0.04 + 2 * 0.01) / 2.0,
                rounding);
    judged.checks.indirect.mean = -0.2;
    judged.evidence.algebraic_bound = 0.001;
    judged.evidence.coarse = 0.03;
    const ErrorReport error = judge(judged.evidence);
    const double alike = (3.0 - 1.0) * 0.2 / std::sqrt(4.0) / 2.0;
    EXPECT_NEAR(*error.form_factors, std::hypot(0.03, alike), rounding);
    EXPECT_NEAR(*error.estimate, 0.001 + std::hypot(*error.form_factors, *error.mesh), rounding);
}

TEST(Judge, TakesWhatGoesRoundAsItWasSentRatherThanGuessed) {
    Judged judged;
    judged.checks.indirect.mean = -0.2;
    judged.evidence.propagated = 0.004;
    EXPECT_NEAR(*judge(judged.evidence).form_factors, 0.004, rounding);
}

TEST(Judge, IsNeverBelowWhatTheResidualComesToFromPointToPoint) {
    Judged judged;
    judged.evidence.propagated = 0.0;
    judged.evidence.carried = MeasuredError{0.01, 0.0, 0.0, 400};  // the residual's own square
    EXPECT_EQ(*judge(judged.evidence, 0.0).form_factors, 0.0) << "passed_on counts more";
    judged.evidence.carried->square = 0.25;
    EXPECT_NEAR(*judge(judged.evidence, 0.0).estimate, flattened * std::sqrt(0.03 + 0.25) / 2.0,
                rounding);
    judged.evidence.carried->variance = 0.01;
    EXPECT_NEAR(*judge(judged.evidence, 2.0).estimate,
                flattened * std::sqrt(0.03 + 0.25 + 2 * 0.1) / 2.0, rounding);
}

TEST(Judge, IsNeverBelowWhatParticlesOrTheEnergyProve) {
    Judged judged;
    judged.evidence.transport = TransportCheck{0.6, 0.0, 0.5, 0.0, 1000, 1000};
    EXPECT_NEAR(*judge(judged.evidence).estimate, 0.6, rounding);
    judged.evidence.transport->doubt = 0.8;
    EXPECT_NEAR(*judge(judged.evidence).estimate, 1.0, rounding);
    judged.evidence.transport.reset();
    judged.evidence.proven_by_energy = 0.7;
    EXPECT_NEAR(*judge(judged.evidence).estimate, 0.7, rounding);
}

TEST(Judge, IsNotMetWhileEnergyIsMissing) {
    Judged judged;
    judged.evidence.energy.defect = 0.25;
    judged.evidence.energy.standard_error = 0.02;
    EXPECT_FALSE(judge(judged.evidence, 0.0).met());
    judged.evidence.energy.standard_error = 0.03;
    EXPECT_TRUE(judge(judged.evidence, 0.0).met()) << "two standard errors may be chance";
}

TEST(Judge, SaysNothingWhereNoLightIsSentBack) {
    Judged judged;
    judged.evidence.light.norm = 0.0;
    EXPECT_FALSE(judge(judged.evidence).estimate);
}

}  // namespace
}  // namespace patchlight::judge_test
