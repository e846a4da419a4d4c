#include "tests/solver/form_factors/closed_forms.h"
#include "tests/stability/furnace.h"
#include "tests/stability/lit_pair.h"

#include <algorithm>
#include <cmath>

namespace patchlight::stability::singular_edges_test {
namespace {

constexpr double asked = 0.02;  // relative: the accuracy a solve has if nothing is said
constexpr HandSet one_patch{4.0, 4096, 1e-6}, coarse{0.34, 256, 1e-6};

class SingularEdges : public EveryColumn {};

Excuse by_counting(const Column& column, double factor) {
    if (!column.counts()) return {};
    return {3.0 * binomial(factor, one_patch.rays), "counts that hit are binomial: 1/√(nF)"};
}

TEST_P(SingularEdges, AStripBesideAWallKeepsItsFactor) {
    constexpr double width = 1.0 / 16.0;
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const LitPair strip{parallelogram(Vec3::Zero(), width * x, y),
                        parallelogram(Vec3::Zero(), y, z)};
    const double exact = perpendicular_rectangles(1, width, 1);
    EXPECT_NEAR(exact, 0.453139081, 1e-9) << "s-d16";
    Excuse excuse = by_counting(GetParam(), exact);
    if (GetParam().draws() && GetParam().shoots())
        excuse = {0.75,
                  "the wall shoots from centres of k × k parts, k <= 4, of which the lowest "
                  "lies farther from the edge than the strip is wide: what is nearer, and "
                  "sends most, has no centre"};
    judge("A9", GetParam(), relative_error(strip, exact, GetParam(), one_patch), asked, excuse);
}

TEST_P(SingularEdges, OfAReceiverHalfBehindTheLampHalfIsLit) {
    // The lamp lies at z = 0 from x = 0 to 1, the receiver stands at x = 1.2 from z = -1 to 1.
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    constexpr double far = 1.2;
    const LitPair pair{parallelogram(far * x - z, 2.0 * z, y), parallelogram(Vec3::Zero(), x, y)};
    // From the upper half to all up to x = 1.2, less that to the gap before the wall.
    const double upper =
        perpendicular_rectangles(1, 1, far) - perpendicular_rectangles(1, 1, far - 1.0);
    Excuse excuse = by_counting(GetParam(), 0.5 * upper);
    if (GetParam().draws())
        excuse = {0.3 / 4.0,
                  "centres of k × k parts, k <= 4, stand for a patch that the horizon cuts"};
    judge("A13", GetParam(), relative_error(pair, 0.5 * upper, GetParam(), one_patch), asked,
          excuse);
}

TEST_P(SingularEdges, CoplanarAndBackFacingSquaresExchangeNothing) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.5, 0.0);
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    builder.polygon("lamp", builder.material(0.5, 1.0), parallelogram(Vec3::Zero(), x, y));
    builder.polygon("beside it", grey, parallelogram(x, x, y));
    builder.polygon("apart", grey, parallelogram(3 * x + 0.3 * y, x, y));
    builder.polygon("below, facing away", grey, parallelogram(-z, y, x));
    builder.polygon("above, facing away", grey, parallelogram(z, x, y));
    builder.polygon("its back", grey, parallelogram(Vec3::Zero(), y, x));
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    double most = 0.0;
    for (const ObjectReport& object : solution.objects)
        most = std::max(most, object.irradiance.maxCoeff());
    judge("A14", GetParam(), most, 0.0);
}

TEST_P(SingularEdges, SliversAndNeedlesKeepTheFurnaceGoing) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.5, 1.0);
    builder.box("room", grey, {0, 0, 0}, {1, 1, 1}, true);
    const MaterialIndex both = builder.material(0.5, 1.0);
    builder.scene.materials[both].two_sided = true;
    constexpr double thin = 1e-4, sharp = 1.0 / 2000.0;
    builder.polygon("sliver", both, parallelogram({0.3, 0.2, 0.4}, {thin, 0, 0}, {0, 0.5, 0}));
    builder.polygon("needle", both, {{0.2, 0.6, 0.6}, {0.8, 0.6, 0.6}, {0.8, 0.6 + sharp, 0.6}});
    judge("A11", GetParam(),
          furnace_error(builder.scene, solve(builder.scene, GetParam(), coarse), 2.0),
          furnace_closure, one_ended_rows(GetParam(), thin / 6.0));
}

TEST_P(SingularEdges, ConcaveAndWarpedPolygonsKeepTheFurnaceGoing) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.5, 1.0);
    const std::vector<Vec3> outline{{0, 0, 0}, {2, 0, 0}, {2, 1, 0},
                                    {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};  // an L
    // One corner of the ceiling hangs down: walls end there, and the ceiling is off its plane.
    const auto above = [&](std::size_t k) {
        return Vec3(outline[k] + Vec3(0, 0, k == 1 ? 0.9 : 1.0));
    };
    std::vector<Vec3> ceiling;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const std::size_t next = (k + 1) % outline.size();
        builder.polygon("wall", grey, {outline[k], above(k), above(next), outline[next]});
        ceiling.insert(ceiling.begin(), above(k));
    }
    builder.polygon("floor", grey, outline);
    builder.polygon("ceiling", grey, ceiling);
    const Solution solution = solve(builder.scene, GetParam(), coarse);
    EXPECT_TRUE(std::any_of(solution.findings.begin(), solution.findings.end(),
                            [](const Finding& finding) { return finding.kind == "non-planar"; }));
    judge("A15", GetParam(), furnace_error(builder.scene, solution, 2.0), furnace_closure,
          one_ended_rows(GetParam(), 0.02));
}

PATCHLIGHT_EVERY_COLUMN(SingularEdges);

}  // namespace
}  // namespace patchlight::stability::singular_edges_test
