#include "solver/form_factors/unoccluded_exchange.h"

#include "solver/form_factors/contour_exchange.h"
#include "solver/form_factors/point_factor.h"
#include "solver/scene/polygon.h"
#include "tests/solver/form_factors/closed_forms.h"
#include "tests/solver/form_factors/polygons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::unoccluded_exchange_test {
namespace {

constexpr double promised = 3e-7;  // relative error, in the median over poses

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// The exchange of patches 0 and 1 of a scene that is not cut further.
double exchange_between(const Polygon& p, const Polygon& q) {
    const CutScene both = cut(scene_of({p, q}), 1e9);
    EXPECT_EQ(both.mesh.size(), 2u);
    return UnoccludedExchange(both.scene, both.mesh, find_plane_groups(both.scene))(0, 1);
}

Polygon square() { return rectangle(Vec3::Zero(), x, y); }

/// The turn that takes z to `normal`.
Eigen::Matrix3d turn_to(const Vec3& normal) {
    const PlaneFrame frame = frame_of(Vec3::Zero(), normal);
    Eigen::Matrix3d turn;
    turn << frame.u, frame.v, frame.normal;
    return turn;
}

TEST(UnoccludedExchange, IsExactlyZeroWithinASurfaceAndAPlane) {
    const CutScene floor = cut(scene_of({square(), rectangle(2.0 * x, x, y)}), 0.3);
    const UnoccludedExchange exchange_of(floor.scene, floor.mesh, find_plane_groups(floor.scene));
    for (PatchIndex i = 0; i < floor.mesh.size(); ++i)
        for (PatchIndex j = 0; j < floor.mesh.size(); ++j) EXPECT_EQ(exchange_of(i, j), 0.0);
}

TEST(UnoccludedExchange, IsExactlyZeroInATurnedPlaneToo) {
    for (const double scale : {1e-4, 1.0, 1e6}) {
        const Motion motion{scale, scale * Vec3(3, -2, 7), odd_turn()};
        EXPECT_EQ(
            exchange_between(moved(square(), motion), moved(rectangle(2.0 * x, x, y), motion)),
            0.0);
    }
}

TEST(UnoccludedExchange, IsExactlyZeroForBacks) {
    const Polygon above = rectangle(z, x, y);  // faces up, away from the floor
    EXPECT_EQ(exchange_between(square(), above), 0.0);
    EXPECT_EQ(exchange_between(reversed(square()), reversed(above)), 0.0);
    EXPECT_EQ(exchange_between(reversed(square()), above), 0.0);
    EXPECT_EQ(exchange_between(square(), rectangle(1.5 * x, y, z)),
              0.0);  // a wall seen from behind
}

TEST(UnoccludedExchange, IsExactlyZeroForCoveredPatches) {
    const CutScene scene = cut(scene_of({square(), square(), rectangle(z, y, x)}), 0.5);
    const UnoccludedExchange exchange_of(scene.scene, scene.mesh, find_plane_groups(scene.scene));
    for (PatchIndex i = 0; i < scene.mesh.first_of_surface[1]; ++i)
        for (PatchIndex j = scene.mesh.first_of_surface[2]; j < scene.mesh.size(); ++j)
            EXPECT_EQ(exchange_of(i, j), 0.0);
}

TEST(UnoccludedExchange, MeetsClosedFormsOnFinelyCutPlates) {
    const CutScene plates =
        cut(scene_of({square(), rectangle(z, y, x), rectangle(Vec3::Zero(), y, z)}), 0.125);
    const UnoccludedExchange exchange_of(plates.scene, plates.mesh,
                                         find_plane_groups(plates.scene));
    const auto between = [&](SurfaceIndex s, SurfaceIndex t) {
        double sum = 0.0;
        const auto& first = plates.mesh.first_of_surface;
        for (PatchIndex i = first[s]; i < first[s + 1]; ++i)
            for (PatchIndex j = first[t]; j < first[t + 1]; ++j) sum += exchange_of(i, j);
        return sum;
    };
    EXPECT_NEAR(between(0, 1), parallel_rectangles(1, 1, 1), promised);
    EXPECT_NEAR(between(0, 2), perpendicular_rectangles(1, 1, 1), promised);
    EXPECT_NEAR(between(1, 2), perpendicular_rectangles(1, 1, 1), promised);
}

struct Poses {
    int corners;   // of both polygons
    double ratio;  // distance of their centres over the larger radius [1]
    friend std::ostream& operator<<(std::ostream& out, const Poses& poses) {
        return out << poses.corners << " corners at " << poses.ratio;
    }
};

double radius_of(const Polygon& polygon) {
    const Vec3 centre = centroid(polygon, normal_of(polygon));
    double radius = 0.0;
    for (const Vec3& p : polygon) radius = std::max(radius, (p - centre).norm());
    return radius;
}

/// Sorted relative errors against the contour integral over random poses.
std::vector<double> errors_at(const Poses& poses, int count, unsigned seed) {
    std::mt19937 chance(seed);
    std::vector<double> errors;
    while (static_cast<int>(errors.size()) < count) {
        const Polygon p = random_facet(chance, poses.corners);
        Polygon q = moved(random_facet(chance, poses.corners), {0.2 + 0.8 * uniform(chance)});
        const double distance = poses.ratio * std::max(radius_of(p), radius_of(q));
        const Vec3 apart = centroid(p, normal_of(p)) - centroid(q, normal_of(q));
        q = moved(q, {1.0, apart + distance * random_direction(chance)});
        if (!face_each_other(p, q)) continue;
        const double exact = contour_exchange(convex(p), convex(q));
        errors.push_back(std::abs(exchange_between(p, q) - exact) / exact);
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

class Distances : public testing::TestWithParam<Poses> {};

TEST_P(Distances, AgreesWithTheContourIntegral) {
    const std::vector<double> errors = errors_at(GetParam(), 300, 1);
    EXPECT_LT(errors[errors.size() / 2], 2 * promised);  // of facets more ragged than patches are
    // The largest are edge on, where the factor itself is next to nothing.
    EXPECT_LT(errors.back(), 300 * promised);
}

// Just before and just past the distances where one rule hands over to the next, and between.
INSTANTIATE_TEST_SUITE_P(
    UnoccludedExchange, Distances,
    testing::Values(Poses{4, 2.0}, Poses{4, 3.0}, Poses{4, 6.0}, Poses{4, 16.0}, Poses{4, 4.4},
                    Poses{4, 4.6}, Poses{4, 8.9}, Poses{4, 9.1}, Poses{4, 29.9}, Poses{4, 30.1},
                    Poses{3, 2.0}, Poses{3, 3.0}, Poses{3, 7.0}, Poses{3, 32.0}, Poses{3, 4.9},
                    Poses{3, 5.1}, Poses{3, 11.9}, Poses{3, 12.1}, Poses{3, 59.9}, Poses{3, 60.1}));

TEST(UnoccludedExchange, DoesNotDependOnTheOrderOfThePair) {
    const double rounding = 1e-8;  // the contour integral's
    const CutScene cut_room = cut(room_with_box(), 0.3);
    const UnoccludedExchange exchange_of(cut_room.scene, cut_room.mesh,
                                         find_plane_groups(cut_room.scene));
    for (PatchIndex i = 0; i < cut_room.mesh.size(); ++i)
        for (PatchIndex j = i + 1; j < cut_room.mesh.size(); ++j) {
            const double forth = exchange_of(i, j);
            ASSERT_NEAR(exchange_of(j, i), forth, rounding * forth) << i << ' ' << j;
        }
}

TEST(UnoccludedExchange, CountsOnlyWhatIsInFrontOfAHorizon) {
    // A wall stands through the floor's plane, one away from it: the floor sees its upper half.
    const Polygon wall = rectangle(Vec3(-1, 0, -1), y, 2.0 * z);
    const double exact = 2 * perpendicular_rectangles(1, 2, 1) - perpendicular_rectangles(1, 1, 1);
    EXPECT_NEAR(exchange_between(square(), wall), exact, promised * exact);
}

TEST(UnoccludedExchange, PairsThatCutEachOthersHorizonAgreeWithLambert) {
    const double of_midpoints = 2e-3;  // 48² of them, of a factor that breaks off at the horizon
    std::mt19937 chance(3);
    for (const double ratio : {2.5, 7.0, 20.0}) {
        int pairs = 0;
        while (pairs < 20) {
            const Polygon p = rectangle(Vec3(-0.5, -0.5, 0), x, y);
            const Polygon q =
                moved(rectangle(Vec3(-0.7, -0.7, 0), 1.4 * x, 1.4 * y),
                      {1.0, ratio * random_direction(chance), turn_to(random_direction(chance))});
            if (face_each_other(p, q)) continue;
            double sum = 0.0;
            constexpr int n = 48;
            for (int k = 0; k < n * n; ++k) {
                const Vec3 point((k % n + 0.5) / n - 0.5, (k / n + 0.5) / n - 0.5, 0.0);
                sum += point_factor(point, z, convex(q), normal_of(q)) / (n * n);
            }
            if (sum < 1e-2 / (ratio * ratio)) continue;  // next to nothing is in front
            EXPECT_NEAR(exchange_between(p, q), sum, of_midpoints * sum) << ratio;
            ++pairs;
        }
    }
}

TEST(UnoccludedExchange, ScalesWithArea) {
    const Polygon p = square(), q = moved(square(), {1.0, Vec3(0.3, 2.0, 3.0), turn_to(-z)});
    const double at_home = exchange_between(p, q);
    ASSERT_GT(at_home, 0.0);
    for (const double scale : {1e-4, 1e6}) {
        const Motion motion{scale, scale * Vec3(5, 5, 5)};
        EXPECT_NEAR(exchange_between(moved(p, motion), moved(q, motion)) / scale / scale, at_home,
                    1e-9 * at_home)
            << scale;
    }
}

TEST(UnoccludedExchange, TheTwoSidesOfASlantedFaceDoNotSeeEachOther) {
    // Corners rounded to eight digits: the back lies in front of the front here, by 1e-9.
    const auto ring = [](double radius, double height, int k) {
        const double angle = k * 1.0471975511965976;
        return Vec3(std::round(radius * std::cos(angle) * 1e8) / 1e8,
                    std::round(radius * std::sin(angle) * 1e8) / 1e8, height);
    };
    Scene scene = empty_scene();
    for (int k = 0; k < 6; ++k)
        add(scene,
            {ring(0.2, 0, k), ring(0.2, 0, k + 1), ring(0.07, 0.22, k + 1), ring(0.07, 0.22, k)},
            two_sided);
    const CutScene frustum = cut(scene, 9.0);
    const UnoccludedExchange exchange_of(frustum.scene, frustum.mesh,
                                         find_plane_groups(frustum.scene));
    for (SurfaceIndex s = 0; s + 1 < frustum.scene.surfaces.size(); s += 2) {
        const PatchIndex front = frustum.mesh.first_of_surface[s],
                         back = frustum.mesh.first_of_surface[s + 1];
        ASSERT_EQ(frustum.scene.surfaces[s + 1].side, Side::back);
        for (PatchIndex i = front; i < back; ++i)
            for (PatchIndex j = back; j < frustum.mesh.first_of_surface[s + 2]; ++j)
                EXPECT_EQ(exchange_of(i, j), 0.0) << s;
    }
}

}  // namespace
}  // namespace patchlight::unoccluded_exchange_test
