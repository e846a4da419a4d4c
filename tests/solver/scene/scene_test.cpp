#include "solver/scene/scene.h"

#include "solver/scene/input_error.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace patchlight::scene_test {
namespace {

constexpr double rounding = 1e-14;  // double arithmetic on numbers of order 1

/// The unit square, its corner 2 lifted by `height`.
Polygon warped_square(double height) {
    Polygon square = flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    square[2].z() = height;
    return square;
}

std::string refused_at(const Polygon& polygon) {
    Scene scene = empty_scene();
    scene.objects.push_back({"culprit"});
    try {
        add_polygon(scene, 0, white, 0, polygon, "/objects/0/polygon");
    } catch (const InputError& error) {
        return error.pointer();
    }
    return "not refused";
}

TEST(AddPolygon, KeepsAPlanarPolygonWhole) {
    const Scene scene = scene_of(l_shape());
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(scene.surfaces[0].corners, l_shape());
    EXPECT_NEAR(scene.surfaces[0].area, 2 * 0.7 + 0.8 * 0.8, rounding);
    EXPECT_LT((scene.surfaces[0].normal - Vec3::UnitZ()).norm(), rounding);
    EXPECT_EQ(scene.surfaces[0].side, Side::front);
    EXPECT_TRUE(scene.findings.empty());
}

TEST(AddPolygon, OverlooksAMillionthOfUnevenness) {
    EXPECT_EQ(scene_of(warped_square(1e-6)).surfaces.size(), 1u);  // 2.5e-7 off its mean plane
}

TEST(AddPolygon, CutsAQuadOffItsPlaneFromCorner0ToCorner2) {
    const Polygon square = warped_square(0.1);
    const Scene scene = scene_of(square);
    ASSERT_EQ(scene.surfaces.size(), 2u);
    EXPECT_EQ(scene.surfaces[0].corners, (Polygon{square[0], square[1], square[2]}));
    EXPECT_EQ(scene.surfaces[1].corners, (Polygon{square[0], square[2], square[3]}));
    EXPECT_EQ(scene.surfaces[0].face, scene.surfaces[1].face);
    ASSERT_EQ(scene.findings.size(), 1u);
    EXPECT_EQ(scene.findings[0].kind, "non-planar");
    EXPECT_EQ(scene.findings[0].objects, std::vector<std::string>{"#0"});
    EXPECT_NE(scene.findings[0].detail.find("near (0.5, 0.5, "), std::string::npos);
}

TEST(AddPolygon, JudgesUnevennessAgainstThePolygonsOwnSize) {
    for (const double scale : {1e-4, 1.0, 1e6}) {
        EXPECT_EQ(scene_of(moved(warped_square(1e-6), {scale})).surfaces.size(), 1u) << scale;
        EXPECT_EQ(scene_of(moved(warped_square(1e-5), {scale})).surfaces.size(), 2u) << scale;
    }
}

TEST(AddPolygon, CutsAConcaveQuadOffItsPlaneAtItsReflexCorner) {
    Polygon dart = flat({{0, 0}, {0.3, 0.3}, {1, 0}, {0.3, 1}});  // reflex at corner 1
    dart[3].z() = 0.1;
    const Scene scene = scene_of(dart);
    ASSERT_EQ(scene.surfaces.size(), 2u);
    for (const Surface& surface : scene.surfaces) {
        EXPECT_GT(surface.normal.z(), 0.9);
        EXPECT_EQ(std::count(surface.corners.begin(), surface.corners.end(), dart[1]), 1);
        EXPECT_EQ(std::count(surface.corners.begin(), surface.corners.end(), dart[3]), 1);
    }
}

TEST(AddPolygon, CutsAnUnevenPolygonIntoTrianglesThatAllFaceItsWay) {
    Polygon uneven = star(7, 0.4);
    std::mt19937 chance(1);
    for (Vec3& p : uneven) p.z() = 0.02 * uniform(chance);
    const Scene scene = scene_of(uneven);
    EXPECT_EQ(scene.surfaces.size(), uneven.size() - 2);
    for (const Surface& surface : scene.surfaces) EXPECT_GT(surface.normal.z(), 0.0);
    EXPECT_EQ(scene.findings[0].count, 1u);  // polygons, not triangles
}

TEST(AddPolygon, DropsPolygonsWithoutAreaAndCountsThem) {
    Scene scene = empty_scene();
    scene.objects.push_back({"crumbs"});
    const std::vector<Polygon> crumbs{flat({{0, 0}, {1, 1}, {2, 2}}),
                                      flat({{0, 0}, {1, 0}}),
                                      flat({{3, 3}, {3, 3}, {3, 3}, {3, 3}}),
                                      {}};
    for (const Polygon& crumb : crumbs) add_polygon(scene, 0, white, 0, crumb, "/objects/0");
    EXPECT_TRUE(scene.surfaces.empty());
    ASSERT_EQ(scene.findings.size(), 1u);
    EXPECT_EQ(scene.findings[0].kind, "degenerate-dropped");
    EXPECT_EQ(scene.findings[0].objects, std::vector<std::string>{"crumbs"});
    EXPECT_EQ(scene.findings[0].count, crumbs.size());
    EXPECT_NE(scene.findings[0].detail.find("near (0, 0, 0) m"), std::string::npos);
}

TEST(AddPolygon, RefusesLoopsWhoseAreasCancel) {
    for (const Polygon& knot : {flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}}),
                                flat({{0, 0}, {2, 0}, {2, 2}, {0, -2}, {2, -2}, {2, 0}})}) {
        Scene scene = empty_scene();
        scene.objects.push_back({"knot"});
        EXPECT_THROW(add_polygon(scene, 0, white, 0, knot, "/objects/0"), InputError);
    }
}

TEST(AddPolygon, CountsFindingsObjectByObjectWhateverTheOrder) {
    Scene scene = empty_scene();
    scene.objects = {{"a"}, {"b"}, {"a"}};
    const Polygon crumb = flat({{0, 0}, {1, 1}, {2, 2}});
    for (const ObjectIndex object : {0u, 1u, 0u, 2u, 1u, 0u})
        add_polygon(scene, object, white, 0, crumb, "/objects/0");
    add_polygon(scene, 1, white, 0, warped_square(0.1), "/objects/1");
    ASSERT_EQ(scene.findings.size(), 4u);  // the two objects called "a" are not confused
    EXPECT_EQ(scene.findings[0].count, 3u);
    EXPECT_EQ(scene.findings[1].count, 2u);
    EXPECT_EQ(scene.findings[2].count, 1u);
    EXPECT_EQ(scene.findings[3].kind, "non-planar");
    EXPECT_EQ(scene.findings[3].objects, std::vector<std::string>{"b"});
}

TEST(AddPolygon, KeepsANeedle) {
    EXPECT_EQ(scene_of(flat({{0, 0}, {1, 0}, {1, 1e-6}, {0, 1e-6}})).surfaces.size(), 1u);
}

TEST(AddPolygon, TakesRepeatedCornersForOne) {
    const Scene scene =
        scene_of(flat({{0, 0}, {0, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}, {0, 0}}));
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(scene.surfaces[0].corners, flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
}

TEST(AddPolygon, KeepsCornersOnAStraightEdge) {
    const Scene scene = scene_of(comb(3));
    ASSERT_EQ(scene.surfaces.size(), 1u);
    EXPECT_EQ(scene.surfaces[0].corners.size(), comb(3).size());
    EXPECT_NEAR(scene.surfaces[0].area, 6 + 3 * 2, rounding * 12);
}

TEST(AddPolygon, RefusesAPolygonThatCrossesItself) {
    EXPECT_EQ(refused_at(flat({{0, 0}, {2, 2}, {2, 0}, {0, 1}})), "/objects/0/polygon");
    Polygon pentagram;
    for (const std::size_t k : {0, 2, 4, 1, 3}) pentagram.push_back(regular(5, 1.0)[k]);
    EXPECT_EQ(refused_at(pentagram), "/objects/0/polygon");
}

TEST(AddPolygon, RefusesAPolygonThatTouchesItself) {
    const Polygon pinched = flat({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}});
    EXPECT_EQ(refused_at(pinched), "/objects/0/polygon");
}

TEST(AddPolygon, RefusesMoreThan4096Corners) {
    EXPECT_EQ(refused_at(regular(4097, 1.0)), "/objects/0/polygon");
}

TEST(AddPolygon, MakesTwoOpposedSurfacesOfATwoSidedPolygon) {
    Scene scene = empty_scene();
    add(scene, l_shape(), two_sided);
    ASSERT_EQ(scene.surfaces.size(), 2u);
    const Surface &front = scene.surfaces[0], &back = scene.surfaces[1];
    EXPECT_EQ(back.corners, reversed(front.corners));
    EXPECT_EQ(back.normal, -front.normal);
    EXPECT_EQ(back.area, front.area);
    EXPECT_EQ(front.side, Side::front);
    EXPECT_EQ(back.side, Side::back);
    EXPECT_EQ(back.object, front.object);
    EXPECT_EQ(back.face, front.face);
}

TEST(AddPolygon, MakesFourSurfacesOfATwoSidedQuadOffItsPlane) {
    Scene scene = empty_scene();
    add(scene, warped_square(0.1), two_sided);
    ASSERT_EQ(scene.surfaces.size(), 4u);
    Vec3 sum = Vec3::Zero();
    for (const Surface& surface : scene.surfaces) sum += surface.area * surface.normal;
    EXPECT_LT(sum.norm(), rounding);
}

TEST(AddPolygon, TurnsTheFrontRoundWithTheOrderOfTheCorners) {
    EXPECT_LT((scene_of(reversed(l_shape())).surfaces[0].normal + Vec3::UnitZ()).norm(), rounding);
}

TEST(AddPolygon, AMirroredPolygonListedBackwardsHasTheMirroredFront) {
    const Motion turned{1.0, Vec3::Zero(), odd_turn()};
    const Polygon original = moved(star(5, 0.4), turned);
    Polygon mirrored = reversed(original);
    for (Vec3& p : mirrored) p.x() = -p.x();
    const Vec3 normal = scene_of(original).surfaces[0].normal;
    const Vec3 expected(-normal.x(), normal.y(), normal.z());
    EXPECT_LT((scene_of(mirrored).surfaces[0].normal - expected).norm(), rounding);
}

TEST(SceneSize, IsTheDiagonalOfTheBoxRoundAllSurfaces) {
    EXPECT_EQ(scene_size(empty_scene()), 0.0);
    EXPECT_NEAR(scene_size(room()), std::sqrt(3.0), rounding);
    EXPECT_NEAR(scene_size(moved(room(), {100.0, Vec3(1e4, 0, 0)})), 100 * std::sqrt(3.0), 1e-9);
}

}  // namespace
}  // namespace patchlight::scene_test
