#include "solver/scene/seen_area.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::seen_area_test {
namespace {

constexpr double rounding = 1e-12;
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
const Polygon square = rectangle(Vec3::Zero(), x, y);

std::vector<double> seen(const std::vector<Polygon>& polygons) {
    const Scene scene = scene_of(polygons);
    return seen_areas(scene, find_coplanar_overlaps(scene));
}

TEST(SeenAreas, AreWholeWhereNothingCovers) {
    EXPECT_EQ(seen({square})[0], 1.0);
    EXPECT_EQ(seen({square, rectangle(Vec3(0, 0, 0.1), x, y)})[0], 1.0);
    EXPECT_EQ(seen({square, reversed(square)})[0], 1.0);  // back to back
}

TEST(SeenAreas, LackWhatACoverTakes) {
    const std::vector<double> areas = seen({square, rectangle(0.5 * x, x, y)});
    EXPECT_NEAR(areas[0], 0.5, rounding);
    EXPECT_EQ(areas[1], 1.0);
}

TEST(SeenAreas, CountOverlappingCoversOnce) {
    EXPECT_NEAR(seen({square, rectangle(0.1 * (x + y), 0.5 * x, 0.5 * y),
                      rectangle(0.3 * (x + y), 0.5 * x, 0.5 * y)})[0],
                1.0 - (0.25 + 0.25 - 0.09), rounding);
}

TEST(SeenAreas, OfAllButTheLastOfManyEqualFacesAreNothing) {
    const std::vector<double> areas = seen(std::vector<Polygon>(200, square));
    for (std::size_t s = 0; s + 1 < areas.size(); ++s) EXPECT_EQ(areas[s], 0.0) << s;
    EXPECT_EQ(areas.back(), 1.0);
}

TEST(SeenAreas, OfAnOutlineWithANotchAreRight) {
    const Scene scene = scene_of({l_shape(), rectangle(Vec3(-5, -5, 0), 10 * x, 10 * y)});
    EXPECT_EQ(seen_areas(scene, find_coplanar_overlaps(scene))[0], 0.0);
    const Scene other = scene_of({rectangle(Vec3(-5, -5, 0), 10 * x, 10 * y), l_shape()});
    EXPECT_NEAR(seen_areas(other, find_coplanar_overlaps(other))[0], 100.0 - other.surfaces[1].area,
                100.0 * rounding);
}

TEST(SeenAreas, OfADiscUnderASquareIsTheRest) {
    const Polygon disc = regular(64, 1.0);
    const Scene scene = scene_of({disc, rectangle(Vec3(-0.5, -0.5, 0), x, y)});
    EXPECT_NEAR(seen_areas(scene, find_coplanar_overlaps(scene))[0], scene.surfaces[0].area - 1.0,
                rounding);
}

}  // namespace
}  // namespace patchlight::seen_area_test
