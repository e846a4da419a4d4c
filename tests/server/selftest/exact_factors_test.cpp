#include "server/selftest/exact_factors.h"

#include "server/selftest/known_scene.h"

#include <gtest/gtest.h>

#include <numbers>

namespace patchlight::server::exact_factors_test {
namespace {

constexpr double printed = 5e-15;  // sources print 15 digits and more

TEST(ExactFactors, OfParallelRectanglesMeetThePrintedDigits) {
    EXPECT_NEAR(parallel_rectangles({0, 1}, {0, 1}, {0, 1}, {0, 1}, 1.0), 0.199824895698387383,
                printed);
    EXPECT_NEAR(parallel_rectangles({0, 2}, {0, 3}, {0, 2}, {0, 3}, 0.5), 0.679537091656778598,
                printed);
    EXPECT_NEAR(parallel_rectangles({0, 2}, {0, 1}, {1.5, 4}, {-1, 0.5}, 1.25),
                0.117942609910993863, printed);
}

TEST(ExactFactors, OfPerpendicularRectanglesMeetThePrintedDigits) {
    EXPECT_NEAR(perpendicular_rectangles({0, 1}, {0, 1}, {0, 1}, {0, 1}), 0.200043776075403154,
                printed);
    EXPECT_NEAR(perpendicular_rectangles({0, 3}, {0, 2}, {0, 2}, {0, 0.5}), 0.0627963581976321887,
                printed);
    EXPECT_NEAR(perpendicular_rectangles({0.5, 2}, {0, 1}, {-0.5, 0.75}, {0.25, 1.5}),
                0.0794678425627307386, printed);
}

TEST(ExactFactors, OfAnElementMeetThePrintedDigits) {
    const std::vector<Vec3> square{{0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}},
        wall{{0, 0, 0}, {0, 1, 0}, {0, 1, 2}, {0, 0, 2}};
    EXPECT_NEAR(element_to_polygon(Vec3::Zero(), Vec3::UnitZ(), square), 0.138531605994892997,
                printed);
    EXPECT_NEAR(element_to_polygon(Vec3::UnitX(), Vec3::UnitZ(), wall), 0.0950679411924033076,
                printed);
}

TEST(ExactFactors, TheFacesOfACubeShareTheWholeSolidAngle) {
    const Vec3 centre = Vec3::Constant(0.5), aside(0.2, 0.3, 0.9);
    double all = 0.0;
    for (std::size_t face = 0; face < 6; ++face) {
        const std::vector<Vec3> corners = cube_face(face, 0, 1, 0, 1);
        EXPECT_NEAR(solid_angle(centre, corners), 4 * std::numbers::pi / 6, printed);
        all += solid_angle(aside, corners);
    }
    EXPECT_NEAR(all, 4 * std::numbers::pi, 4 * printed);
}

}  // namespace
}  // namespace patchlight::server::exact_factors_test
