#include "solver/scene/holes.h"

#include "solver/scene/input_error.h"
#include "solver/scene/keyholes.h"
#include "solver/scene/polygon_with_holes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight::holes_test {
namespace {

using Corners = std::vector<Vec3>;

Corners square(double x, double y, double side) {
    return {Vec3(x, y, 0), Vec3(x + side, y, 0), Vec3(x + side, y + side, 0), Vec3(x, y + side, 0)};
}

Corners ring(double x, double y, double radius, int corners) {
    Corners round;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / corners + 0.1;
        round.emplace_back(x + radius * std::cos(angle), y + radius * std::sin(angle), 0.0);
    }
    return round;
}

Scene empty_scene(bool two_sided = false) {
    Scene scene;
    scene.materials.push_back({"white", Rgb::Constant(0.5), Rgb::Zero(), two_sided});
    scene.objects.push_back({"wall", {}});
    return scene;
}

Scene with_holes(const Corners& outline, const Rings<Vec3>& holes) {
    Scene scene = empty_scene();
    add_polygon_with_holes(scene, 0, 0, 7, outline, holes, "/holes");
    return scene;
}

double area(const Scene& scene) {
    double sum = 0.0;
    for (const Surface& surface : scene.surfaces) sum += surface.area;
    return sum;
}

bool is_convex(const Surface& surface) {
    const std::size_t n = surface.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = surface.corners[k], &b = surface.corners[(k + 1) % n],
                   &c = surface.corners[(k + 2) % n];
        if ((b - a).cross(c - b).dot(surface.normal) < -1e-12) return false;
    }
    return true;
}

/// How many pieces hold a point of the plane.
int covering(const Scene& scene, const Vec3& p) {
    int count = 0;
    for (const Surface& surface : scene.surfaces) {
        const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
        std::vector<Vec2> flat;
        for (const Vec3& corner : surface.corners) flat.push_back(frame.flat(corner));
        count += contains(flat, frame.flat(p));
    }
    return count;
}

constexpr double rounding = 1e-12;

TEST(Holes, LeaveConvexPiecesOfOneFace) {
    const Scene scene = with_holes(square(0, 0, 1), {square(0.25, 0.25, 0.5)});
    EXPECT_NEAR(area(scene), 0.75, rounding);
    EXPECT_EQ(scene.surfaces.size(), 4u);
    for (const Surface& surface : scene.surfaces) {
        EXPECT_EQ(surface.face, 7u);
        EXPECT_GT(surface.normal.z(), 0.999);
        EXPECT_TRUE(is_convex(surface));
    }
    EXPECT_EQ(covering(scene, Vec3(0.51, 0.49, 0)), 0);
    EXPECT_EQ(covering(scene, Vec3(0.1, 0.51, 0)), 1);
}

TEST(Holes, MayRunEitherWayRound) {
    Corners hole = square(0.25, 0.25, 0.5);
    std::reverse(hole.begin(), hole.end());
    Corners outline = square(0, 0, 1);
    EXPECT_NEAR(area(with_holes(outline, {hole})), 0.75, rounding);
    std::reverse(outline.begin(), outline.end());
    const Scene scene = with_holes(outline, {hole});
    EXPECT_NEAR(area(scene), 0.75, rounding);
    EXPECT_LT(scene.surfaces[0].normal.z(), -0.999);
}

TEST(Holes, MayBeManyAndRoundInAnyOutline) {
    Rings<Vec3> holes;
    double cut = 0.0;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 5; ++j) {
            holes.push_back(ring(i + 0.5, j + 0.5, 0.3, 8));
            cut += vector_area(holes.back()).norm();
        }
    // An L, so that bridges must not leave it.
    const Corners outline{Vec3(0, 0, 0),   Vec3(20, 0, 0), Vec3(20, -9, 0),
                          Vec3(22, -9, 0), Vec3(22, 5, 0), Vec3(0, 5, 0)};
    const Scene scene = with_holes(outline, holes);
    EXPECT_NEAR(area(scene), vector_area(outline).norm() - cut, 1e-9);
    for (const Surface& surface : scene.surfaces) EXPECT_TRUE(is_convex(surface));
    for (const Corners& hole : holes) EXPECT_EQ(covering(scene, 0.5 * (hole[0] + hole[4])), 0);
    EXPECT_EQ(covering(scene, Vec3(21, -5, 0)), 1);
}

TEST(Holes, OfTwoSidedMaterialsAreOpenFromBothSides) {
    Scene scene = empty_scene(true);
    add_polygon_with_holes(scene, 0, 0, 0, square(0, 0, 1), Rings<Vec3>{square(0.25, 0.25, 0.5)},
                           "");
    EXPECT_NEAR(area(scene), 1.5, rounding);
}

void expect_refused(const Corners& outline, const Rings<Vec3>& holes, const std::string& words) {
    try {
        with_holes(outline, holes);
        ADD_FAILURE() << "accepted; expected: " << words;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(Holes, ThatLeaveNoOneAreaAreRefused) {
    const Corners wall = square(0, 0, 1);
    expect_refused(wall, {square(0.5, 0.5, 1)}, "touches or crosses the edge");
    expect_refused(wall, {square(0.5, 0, 0.2)}, "touches or crosses the edge");
    expect_refused(wall, {square(2, 2, 1)}, "outside");
    expect_refused(wall, {square(0.1, 0.1, 0.5), square(0.2, 0.2, 0.1)}, "inside another");
    expect_refused(wall, {square(0.1, 0.1, 0.5), square(0.6, 0.2, 0.1)}, "two holes touch");
    expect_refused(wall, {square(0.1, 0.1, 0)}, "a hole has no area");
    Corners lifted = square(0.2, 0.2, 0.2);
    for (Vec3& p : lifted) p.z() = 0.1;
    expect_refused(wall, {lifted}, "does not lie in the plane");
}

/// How EnergyPlus and its kin write holes (ladybug-geometry#7, honeybee-core#475).
Scene keyhole(const Corners& corners) {
    Scene scene = empty_scene();
    add_polygon(scene, 0, 0, 0, corners, "/polygon");
    return scene;
}

TEST(Keyholes, AreReadAsHoles) {
    const Corners outline = square(0, 0, 1);
    Corners hole = square(0.25, 0.25, 0.5);
    std::reverse(hole.begin(), hole.end());
    Corners corners = outline;
    corners.push_back(outline[0]);
    corners.insert(corners.end(), hole.begin(), hole.end());
    corners.push_back(hole[0]);
    for (std::size_t turn = 0; turn < corners.size(); ++turn) {
        std::rotate(corners.begin(), corners.begin() + 1, corners.end());
        const Scene scene = keyhole(corners);
        EXPECT_NEAR(area(scene), 0.75, rounding) << turn;
        EXPECT_EQ(covering(scene, Vec3(0.51, 0.49, 0)), 0) << turn;
    }
}

TEST(Keyholes, MayHaveHolesInARow) {
    // From the corner to one hole, from that to the next, and all the way back.
    const Corners corners{Vec3(0, 0, 0),   Vec3(4, 0, 0), Vec3(4, 3, 0),   Vec3(0, 3, 0),
                          Vec3(0, 0, 0),   Vec3(1, 1, 0), Vec3(1, 2, 0),   Vec3(1.5, 2, 0),
                          Vec3(1.5, 1, 0), Vec3(2, 1, 0), Vec3(2, 2, 0),   Vec3(3, 2, 0),
                          Vec3(3, 1, 0),   Vec3(2, 1, 0), Vec3(1.5, 1, 0), Vec3(1, 1, 0)};
    const Scene scene = keyhole(corners);
    EXPECT_NEAR(area(scene), 12 - 0.5 - 1, rounding);
    EXPECT_EQ(covering(scene, Vec3(2.51, 1.49, 0)), 0);
}

TEST(Keyholes, AreNoneWhereCornersCrossOrTurnBack) {
    const auto expect_keyhole_refused = [](const Corners& corners) {
        try {
            keyhole(corners);
            ADD_FAILURE() << "accepted";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("`holes`"), std::string::npos);
        }
    };
    expect_keyhole_refused({Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)});
    expect_keyhole_refused(
        {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)});
    // Two squares that a bridge joins side by side: no outline with a hole.
    expect_keyhole_refused({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0),
                            Vec3(3, 1, 0), Vec3(2, 1, 0), Vec3(2, 0, 0), Vec3(1, 0, 0),
                            Vec3(1, 1, 0), Vec3(0, 1, 0)});
}

}  // namespace
}  // namespace patchlight::holes_test
