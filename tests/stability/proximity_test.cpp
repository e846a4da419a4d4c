#include "tests/solver/form_factors/closed_forms.h"
#include "tests/stability/lit_pair.h"

#include <algorithm>
#include <cmath>

namespace patchlight::stability::proximity_test {
namespace {

constexpr double asked = 0.02;  // relative: the accuracy a solve has if nothing is said
constexpr HandSet one_patch{4.0, 4096, 1e-6};

class Proximity : public EveryColumn {};

/// What counts of rays or centres of parts may err where a share `factor` is hit.
Excuse by_counting(const Column& column, double factor) {
    if (column.casts())
        return {2.0 * binomial(factor, one_patch.rays),
                "counts of rays that hit are binomial: 1/√(nF)"};
    if (column.draws())
        return {0.3 / 4.0,
                "hemicubes at centres of k × k parts, k <= 4: 1 centre errs by up to "
                "0.3, and the error falls as 1/k²"};
    return {};
}

TEST_P(Proximity, SquaresTooNearForTheirSizeKeepTheirFactor) {
    const Column& column = GetParam();
    double worst = 0.0;
    for (const double distance : {1.0, 0.5, 0.2, 0.1})
        worst =
            std::max(worst, relative_error(facing_squares(1, 1, distance),
                                           parallel_rectangles(1, 1, distance), column, one_patch));
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const LitPair corner{parallelogram(Vec3::Zero(), x, y), parallelogram(Vec3::Zero(), y, z)};
    worst = std::max(worst,
                     relative_error(corner, perpendicular_rectangles(1, 1, 1), column, one_patch));
    judge("A1", column, worst, asked, by_counting(column, 0.2));
}

/// Error of hemicubes set by hand falls as the square of the patches, what else they err by as well
/// or faster.
TEST(ProximityOfHemicubes, FallsWithTheSquareOfThePatchSize) {
    const LitPair near = facing_squares(1, 1, 0.5);
    const double exact = parallel_rectangles(1, 1, 0.5);
    const Column& hemicube = every_column()[5];
    ASSERT_TRUE(hemicube.draws() && hemicube.shoots());
    const double coarse = relative_error(near, exact, hemicube, {4.0, 128 * 128, 1e-6}),
                 fine = relative_error(near, exact, hemicube, {0.5, 128 * 128, 1e-6});
    constexpr double half_as_well_as_squares = 0.5;  // a quarter, and aliasing on top
    EXPECT_LT(fine, half_as_well_as_squares * coarse);
}

TEST_P(Proximity, AHalfPlaneBetweenSquaresBlocksHalfOfTheLight) {
    const Column& column = GetParam();
    LitPair pair = facing_squares(1, 1, 1);
    // Lines from x to x' pass it where x + x' > 0: by symmetry half of the light is blocked.
    pair.blockers = {{{0, -5, 0.5}, {5, -5, 0.5}, {5, 5, 0.5}, {0, 5, 0.5}}};
    const double exact = 0.5 * parallel_rectangles(1, 1, 1);
    Excuse excuse = by_counting(column, exact);
    if (column.draws())
        excuse = {0.5 / 4.0,
                  "what k × k centres see stands for the whole patch: the error falls "
                  "as 1/k, k <= 4"};
    if (column.is_analytic())
        excuse = {2.0 * binomial(0.5, one_patch.rays), "visibility is measured by rays: 1/√n"};
    judge("A4", column, relative_error(pair, exact, column, one_patch), asked, excuse);
}

TEST_P(Proximity, NarrowGapsLetAlmostAllLightAcross) {
    const Column& column = GetParam();
    double worst = 0.0;
    for (const double gap : {1e-2, 1e-3, 1e-5}) {
        const double exact = parallel_rectangles(1, 1, gap);
        worst =
            std::max(worst, relative_error(facing_squares(1, 1, gap), exact, column, one_patch));
    }
    judge("A10", column, worst, asked, by_counting(column, 0.98));
}

TEST_P(Proximity, AGapFarSmallerThanTheSceneIsNotClippedAway) {
    const Column& column = GetParam();
    LitPair pair = facing_squares(1, 1, 0.01);
    pair.blockers = {parallelogram({100, 100, 0}, {1, 0, 0}, {0, 1, 0})};
    judge("A16", column, relative_error(pair, parallel_rectangles(1, 1, 0.01), column, one_patch),
          asked, by_counting(column, 0.98));
}

PATCHLIGHT_EVERY_COLUMN(Proximity);

}  // namespace
}  // namespace patchlight::stability::proximity_test
