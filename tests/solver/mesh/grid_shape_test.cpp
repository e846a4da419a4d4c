#include "solver/mesh/grid_shape.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::grid_shape_test {
namespace {

bool fits(const std::vector<std::array<double, 2>>& corners) {
    return fits_a_grid(
        scene_of(moved(flat(corners), {2.0, Vec3(1, 2, 3), odd_turn()})).surfaces[0]);
}

TEST(FitsAGrid, QuadsThatAreNearlyParallelograms) {
    EXPECT_TRUE(fits({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
    EXPECT_TRUE(fits({{0, 0}, {100, 0}, {100, 1}, {0, 1}}));
    EXPECT_TRUE(fits({{0, 0}, {1, 0}, {1.4, 0.9}, {0.3, 1}}));
    EXPECT_TRUE(fits({{0, 0}, {1, 0}, {2, 1}, {1, 1}}));  // 45 degrees
}

TEST(FitsAGrid, NoTrianglesNorPolygonsOfMoreCorners) {
    EXPECT_FALSE(fits({{0, 0}, {1, 0}, {1, 1}}));
    EXPECT_FALSE(fits({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}));
}

TEST(FitsAGrid, NoConcaveOrPointedQuads) {
    EXPECT_FALSE(fits({{0, 0}, {1, 0.4}, {2, 0}, {1, 1}}));
    EXPECT_FALSE(fits({{0, 0}, {1, 0}, {3, 1}, {2, 1}}));     // 27 degrees
    EXPECT_FALSE(fits({{0, 0}, {3, 0}, {2, 1}, {1, 1}}));     // one side 3 times the other
    EXPECT_FALSE(fits({{0, 0}, {1, 0}, {2, 0.01}, {0, 1}}));  // nearly a triangle
}

TEST(WidthOf, IsAboutTheWidthOfANarrowPolygon) {
    const Scene strip = scene_of(flat({{0, 0}, {10, 0}, {10, 0.1}, {0, 0.1}}));
    EXPECT_NEAR(width_of(strip.surfaces[0]), 0.1, 0.002);  // ends count as sides: 1 % less
}

}  // namespace
}  // namespace patchlight::grid_shape_test
