#include "solver/scene/polygon.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace patchlight::polygon_test {
namespace {

constexpr double rounding = 1e-14;      // double arithmetic on numbers of order 1
constexpr double sum_rounding = 1e-12;  // the same over some hundred terms, relative

std::vector<Vec2> in_plane(const Polygon& polygon) {
    std::vector<Vec2> points;
    for (const Vec3& p : polygon) points.emplace_back(p.x(), p.y());
    return points;
}

struct Shape {
    std::string name;
    std::vector<Vec2> outline;
    friend std::ostream& operator<<(std::ostream& out, const Shape& shape) {
        return out << shape.name;
    }
};

std::vector<Shape> shapes() {
    std::vector<Shape> all{
        {"square", in_plane(rectangle(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)))},
        {"l", in_plane(l_shape())},
        {"star", in_plane(star(5, 0.4))},
        {"thin_star", in_plane(star(24, 0.05))},
        {"comb", in_plane(comb(6))},
        {"spiral", in_plane(spiral(4))},
        {"disk", in_plane(regular(64, 1.0))},
        {"needle", in_plane(flat({{0, 0}, {1, 0}, {1, 1e-4}, {0, 1e-4}}))}};
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u})
        all.push_back({"random_" + std::to_string(seed),
                       in_plane(random_outline(seed, 5 + 9 * static_cast<int>(seed)))});
    return all;
}

double area_of(const std::vector<Vec2>& outline) {
    double twice = 0.0;
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 &p = outline[k], &q = outline[(k + 1) % outline.size()];
        twice += p.x() * q.y() - p.y() * q.x();
    }
    return 0.5 * twice;
}

class EveryOutline : public testing::TestWithParam<Shape> {};

TEST_P(EveryOutline, IsCutIntoCounterClockwiseTrianglesThatFillIt) {
    const std::vector<Vec2>& outline = GetParam().outline;
    const auto triangles = triangulate(outline);
    ASSERT_EQ(triangles.size(), outline.size() - 2);
    double area = 0.0;
    for (const auto& [a, b, c] : triangles) {
        const double twice = turn(outline[a], outline[b], outline[c]);
        EXPECT_GT(twice, 0.0);
        area += 0.5 * twice;
    }
    EXPECT_NEAR(area, area_of(outline), sum_rounding * area_of(outline));
}

TEST_P(EveryOutline, DoesNotCrossItself) { EXPECT_FALSE(crosses_itself(GetParam().outline)); }

TEST_P(EveryOutline, ContainsWhatItsTrianglesContain) {
    const std::vector<Vec2>& outline = GetParam().outline;
    const auto triangles = triangulate(outline);
    Eigen::AlignedBox2d box;
    for (const Vec2& p : outline) box.extend(p);
    std::mt19937 chance(1);
    for (int n = 0; n < 2000; ++n) {
        const Vec2 q = box.min() + Vec2(uniform(chance), uniform(chance)).cwiseProduct(box.sizes());
        bool in_any = false;
        double nearest = std::numeric_limits<double>::infinity();  // edge, as twice an area
        for (const auto& [a, b, c] : triangles) {
            const double ab = turn(outline[a], outline[b], q), bc = turn(outline[b], outline[c], q),
                         ca = turn(outline[c], outline[a], q);
            in_any |= ab > 0.0 && bc > 0.0 && ca > 0.0;
            nearest = std::min({nearest, std::abs(ab), std::abs(bc), std::abs(ca)});
        }
        if (nearest < rounding) continue;
        EXPECT_EQ(contains(outline, q), in_any) << q.transpose();
    }
}

INSTANTIATE_TEST_SUITE_P(Polygon, EveryOutline, testing::ValuesIn(shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(Triangulate, LeavesABowTieUnfinished) {
    const std::vector<Vec2> bow_tie = in_plane(flat({{0, 0}, {2, 2}, {2, 0}, {0, 1}}));
    EXPECT_LT(triangulate(bow_tie).size(), bow_tie.size() - 2);
}

TEST(CrossesItself, SeesEdgesThatCrossTouchOrRunOverEachOther) {
    EXPECT_TRUE(crosses_itself(in_plane(flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}}))));
    EXPECT_TRUE(crosses_itself(in_plane(flat({{0, 0}, {2, 0}, {2, 1}, {1, 0}, {0, 1}}))));
    EXPECT_TRUE(crosses_itself(in_plane(flat({{0, 0}, {3, 0}, {3, 1}, {2, 0}, {1, 0}, {0, 1}}))));
}

TEST(VectorArea, IsTheAreaAlongTheNormal) {
    EXPECT_LT((vector_area(l_shape()) - 2.04 * Vec3::UnitZ()).norm(), rounding);
    const Motion motion{3.0, Vec3(5, -7, 2), odd_turn()};
    const Vec3 expected = 9.0 * 2.04 * (motion.turn * Vec3::UnitZ());
    EXPECT_LT((vector_area(moved(l_shape(), motion)) - expected).norm(), sum_rounding);
    EXPECT_EQ(vector_area(flat({{0, 0}, {1, 1}, {2, 2}})), Vec3(0, 0, 0));
}

TEST(Centroid, IsTheCentreOfGravityOfAConcavePolygon) {
    // Of l_shape: 2 × 0.7 about (1, 0.35) and 0.8 × 0.8 about (0.4, 1.1).
    const Vec3 expected = (1.4 * Vec3(1, 0.35, 0) + 0.64 * Vec3(0.4, 1.1, 0)) / 2.04;
    EXPECT_LT((centroid(l_shape(), Vec3::UnitZ()) - expected).norm(), rounding);
    const Motion motion{2.0, Vec3(5, -7, 2), odd_turn()};
    const Vec3 normal = motion.turn * Vec3::UnitZ();
    EXPECT_LT((centroid(moved(l_shape(), motion), normal) - motion(expected)).norm(),
              rounding * 10);
}

TEST(FrameOf, IsOrthonormalAndRightHandedForAnyNormal) {
    std::mt19937 chance(1);
    std::vector<Vec3> normals{Vec3::UnitZ(), -Vec3::UnitZ(), Vec3::UnitX(), -Vec3::UnitY(),
                              Vec3(1e-9, 0, -1).normalized()};
    for (int n = 0; n < 1000; ++n) normals.push_back(random_direction(chance));
    for (const Vec3& normal : normals) {
        const PlaneFrame frame = frame_of(Vec3(1, 2, 3), normal);
        EXPECT_LT((frame.u.cross(frame.v) - normal).norm(), rounding) << normal.transpose();
        EXPECT_NEAR(frame.u.norm(), 1.0, rounding);
        EXPECT_NEAR(frame.v.norm(), 1.0, rounding);
        const Vec2 q(0.3, -0.7);
        EXPECT_LT((frame.flat(frame.lift(q)) - q).norm(), rounding);
    }
}

}  // namespace
}  // namespace patchlight::polygon_test
