#include "solver/scene/coplanar.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::coplanar_test {
namespace {

using Surfaces = std::vector<SurfaceIndex>;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

Polygon floor_at(double height) { return rectangle(Vec3(0, 0, height), x, y); }
Polygon rug_at(double height) { return rectangle(Vec3(0.3, 0.3, height), 0.3 * x, 0.4 * y); }

CoplanarOverlaps overlaps_of(const std::vector<Polygon>& polygons) {
    return find_coplanar_overlaps(scene_of(polygons));
}

TEST(CoplanarOverlaps, ARugListedLaterCoversTheFloor) {
    const CoplanarOverlaps overlaps = overlaps_of({floor_at(0), rug_at(0)});
    EXPECT_EQ(overlaps.covered_by[0], Surfaces{1});
    EXPECT_EQ(overlaps.covered_by[1], Surfaces{});
    EXPECT_EQ(overlaps.partners[0], Surfaces{1});
    EXPECT_EQ(overlaps.partners[1], Surfaces{0});
}

TEST(CoplanarOverlaps, AFloorListedLaterCoversTheRug) {
    const CoplanarOverlaps overlaps = overlaps_of({rug_at(0), floor_at(0)});
    EXPECT_EQ(overlaps.covered_by[0], Surfaces{1});
    EXPECT_EQ(overlaps.covered_by[1], Surfaces{});
}

TEST(CoplanarOverlaps, ThoseThatOverlapInPartCountToo) {
    const Polygon half_off = rectangle(Vec3(0.5, 0.5, 0), x, y);
    EXPECT_EQ(overlaps_of({floor_at(0), half_off}).covered_by[0], Surfaces{1});
}

TEST(CoplanarOverlaps, SeveralCoversAreListedInOrder) {
    const CoplanarOverlaps overlaps =
        overlaps_of({floor_at(0), rectangle(Vec3(0.7, 0, 0), 0.2 * x, 0.2 * y), rug_at(0)});
    EXPECT_EQ(overlaps.covered_by[0], (Surfaces{1, 2}));
    EXPECT_EQ(overlaps.partners[1], Surfaces{0});
}

TEST(CoplanarOverlaps, NeighboursThatShareAnEdgeDoNotOverlap) {
    const CoplanarOverlaps overlaps = overlaps_of({floor_at(0), rectangle(x, x, y)});
    EXPECT_FALSE(overlaps.any(0));
    EXPECT_FALSE(overlaps.any(1));
}

TEST(CoplanarOverlaps, ARugInTheNotchOfAnLDoesNotOverlapIt) {
    const Polygon notch = rectangle(Vec3(0.8, 0.7, 0), 1.2 * x, 0.8 * y);
    EXPECT_FALSE(overlaps_of({l_shape(), notch}).any(0));
    const Polygon beyond = rectangle(Vec3(0.79, 0.7, 0), 1.2 * x, 0.8 * y);
    EXPECT_TRUE(overlaps_of({l_shape(), beyond}).any(0));
}

TEST(CoplanarOverlaps, AnOpposedPairArePartnersButDoNotCoverEachOther) {
    const CoplanarOverlaps overlaps = overlaps_of({floor_at(0), reversed(floor_at(0))});
    EXPECT_EQ(overlaps.partners[0], Surfaces{1});
    EXPECT_EQ(overlaps.partners[1], Surfaces{0});
    EXPECT_TRUE(overlaps.covered_by[0].empty());
    EXPECT_TRUE(overlaps.covered_by[1].empty());
}

TEST(CoplanarOverlaps, BothSidesOfATwoSidedPolygonArePartners) {
    Scene scene = empty_scene();
    add(scene, floor_at(0), two_sided);
    EXPECT_EQ(find_coplanar_overlaps(scene).partners[0], Surfaces{1});
}

TEST(CoplanarOverlaps, ReachAMillionthOfTheSmallerOneAndNoFarther) {
    const double contact = 1e-6 * std::hypot(0.3, 0.4);
    for (const double scale : {1e-4, 1.0, 1e6})
        for (const double side : {-1.0, 1.0}) {
            const auto overlap = [&](double height) {
                return overlaps_of(
                           {moved(floor_at(0), {scale}), moved(rug_at(side * height), {scale})})
                    .any(0);
            };
            EXPECT_TRUE(overlap(0.9 * contact)) << scale;
            EXPECT_FALSE(overlap(1.1 * contact)) << scale;
        }
}

TEST(CoplanarOverlaps, AreFoundInAnyPlane) {
    const Motion motion{2.0, Vec3(100, -50, 30), odd_turn()};
    EXPECT_EQ(overlaps_of({moved(floor_at(0), motion), moved(rug_at(0), motion)}).covered_by[0],
              Surfaces{1});
}

TEST(CoplanarOverlaps, WallsOfARoomHaveNone) {
    const CoplanarOverlaps overlaps = find_coplanar_overlaps(room());
    for (SurfaceIndex s = 0; s < 6; ++s) EXPECT_FALSE(overlaps.any(s)) << s;
}

TEST(ClipLeft, KeepsWhatIsLeftOfTheLine) {
    const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    EXPECT_EQ(clip_left(square, {0.25, 0}, {0.25, 1}),
              (std::vector<Vec2>{{0, 0}, {0.25, 0}, {0.25, 1}, {0, 1}}));
    EXPECT_EQ(clip_left(square, {0, 0}, {1, 1}), (std::vector<Vec2>{{0, 0}, {1, 1}, {0, 1}}));
    EXPECT_EQ(clip_left(square, {2, 0}, {2, 1}), square);
    EXPECT_TRUE(clip_left(square, {-1, 0}, {-1, 1}).empty());
}

}  // namespace
}  // namespace patchlight::coplanar_test
