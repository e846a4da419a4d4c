#include "solver/mesh/triangulation.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace patchlight::triangulation_test {
namespace {

constexpr double area_rounding = 1e-12;   // sums of some thousand triangles
constexpr double circle_rounding = 1e-9;  // of a circle's radius squared: how deep a point may lie

const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

std::vector<Vec2> in_plane(const Polygon& polygon) {
    std::vector<Vec2> points;
    for (const Vec3& p : polygon) points.emplace_back(p.x(), p.y());
    return points;
}

double area_of(const Triangulation& mesh) {
    double area = 0.0;
    for (const auto& t : mesh.triangles()) {
        const double twice = turn(mesh.points()[t.vertices[0]], mesh.points()[t.vertices[1]],
                                  mesh.points()[t.vertices[2]]);
        EXPECT_GT(twice, 0.0);
        area += 0.5 * twice;
    }
    return area;
}

/// Vertex of the triangle beyond edge k of t, opposite that edge.
int apex_beyond(const Triangulation& mesh, int t, int k) {
    const auto& beyond = mesh.triangles()[mesh.triangles()[t].across[k]];
    for (int l = 0; l < 3; ++l)
        if (beyond.across[l] == t) return beyond.vertices[l];
    ADD_FAILURE() << "neighbours disagree at triangle " << t;
    return 0;
}

/// Edges that are not fixed and whose neighbour's apex lies inside the circle round the triangle.
int edges_not_delaunay(const Triangulation& mesh) {
    int count = 0;
    for (int t = 0; t < static_cast<int>(mesh.triangles().size()); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto& triangle = mesh.triangles()[t];
            if (triangle.fixed[k] || triangle.across[k] == Triangulation::none) continue;
            const Vec2 &a = mesh.points()[triangle.vertices[0]],
                       &b = mesh.points()[triangle.vertices[1]],
                       &c = mesh.points()[triangle.vertices[2]];
            const Vec2 p = b - a, q = c - a;
            const double twice = 2.0 * (p.x() * q.y() - p.y() * q.x());
            const Vec2 centre = a + Vec2(q.y() * p.squaredNorm() - p.y() * q.squaredNorm(),
                                         p.x() * q.squaredNorm() - q.x() * p.squaredNorm()) /
                                        twice;
            const double radius2 = (a - centre).squaredNorm();
            const Vec2& apex = mesh.points()[apex_beyond(mesh, t, k)];
            count += (apex - centre).squaredNorm() < radius2 * (1.0 - circle_rounding);
        }
    return count;
}

bool has_edge(const Triangulation& mesh, int a, int b) {
    return std::any_of(mesh.triangles().begin(), mesh.triangles().end(), [&](const auto& t) {
        return std::count(t.vertices.begin(), t.vertices.end(), a) == 1 &&
               std::count(t.vertices.begin(), t.vertices.end(), b) == 1;
    });
}

/// Whether points on the segment are joined by edges from one end to the other.
bool is_joined(const Triangulation& mesh, int a, int b) {
    const Vec2 from = mesh.points()[a], along = mesh.points()[b] - from;
    std::vector<std::pair<double, int>> on;
    for (int v = 0; v < static_cast<int>(mesh.points().size()); ++v) {
        const double t = (mesh.points()[v] - from).dot(along) / along.squaredNorm();
        if (t > -1e-9 && t < 1.0 + 1e-9 && (from + t * along - mesh.points()[v]).norm() < 1e-9)
            on.emplace_back(t, v);
    }
    std::sort(on.begin(), on.end());
    for (std::size_t k = 1; k < on.size(); ++k)
        if (!has_edge(mesh, on[k - 1].second, on[k].second)) return false;
    return true;
}

void add_random_points(Triangulation& mesh, int count, unsigned seed) {
    std::mt19937 chance(seed);
    for (int n = 0; n < count; ++n)
        mesh.insert({2.0 * uniform(chance) - 0.5, 2.0 * uniform(chance) - 0.5});
}

TEST(Triangulation, StartsAsADelaunayTriangulationOfThePolygon) {
    for (const Polygon& polygon : {l_shape(), star(7, 0.4), comb(3), spiral(2), regular(64, 1.0)}) {
        const Triangulation mesh(in_plane(polygon));
        ASSERT_TRUE(mesh.ok());
        EXPECT_EQ(mesh.triangles().size(), polygon.size() - 2);
        EXPECT_NEAR(area_of(mesh), vector_area(polygon).norm(), area_rounding);
        EXPECT_EQ(edges_not_delaunay(mesh), 0);
    }
}

TEST(Triangulation, SaysThatABowTieIsNotSimple) {
    EXPECT_FALSE(Triangulation(in_plane(flat({{0, 0}, {2, 2}, {2, 0}, {0, 1}}))).ok());
}

TEST(Triangulation, StaysDelaunayAsPointsAreAdded) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        Triangulation mesh(square);
        add_random_points(mesh, 800, seed);
        EXPECT_NEAR(area_of(mesh), 1.0, area_rounding);
        EXPECT_EQ(edges_not_delaunay(mesh), 0);
        // Euler: 2 n - 2 - b triangles, and the square's corners alone are on the boundary.
        EXPECT_EQ(mesh.triangles().size(), 2 * mesh.points().size() - 2 - 4);
    }
}

TEST(Triangulation, StaysDelaunayOnALatticeWhereFourPointsShareACircle) {
    Triangulation mesh(square);
    for (int i = 0; i <= 10; ++i)
        for (int j = 0; j <= 10; ++j) mesh.insert({0.1 * i, 0.1 * j});
    EXPECT_EQ(mesh.points().size(), 121u);
    EXPECT_EQ(mesh.triangles().size(), 200u);
    EXPECT_NEAR(area_of(mesh), 1.0, area_rounding);
    EXPECT_EQ(edges_not_delaunay(mesh), 0);
}

TEST(Triangulation, KnowsAPointThatIsThere) {
    Triangulation mesh(square);
    const std::optional<int> fresh = mesh.insert({0.3, 0.4});
    EXPECT_EQ(fresh, 4);
    EXPECT_EQ(mesh.insert({0.3, 0.4}), fresh);
    EXPECT_EQ(mesh.insert({0.3 + 1e-12, 0.4}), fresh);
    EXPECT_EQ(mesh.insert({1, 1}), 2);
    EXPECT_EQ(mesh.points().size(), 5u);
}

TEST(Triangulation, RefusesAPointOutside) {
    Triangulation mesh(in_plane(l_shape()));
    EXPECT_EQ(mesh.insert({-0.1, 0.5}), std::nullopt);
    EXPECT_EQ(mesh.insert({1.5, 1.2}), std::nullopt);  // in the notch
    EXPECT_EQ(mesh.points().size(), 6u);
}

TEST(Triangulation, SplitsAnEdgeThatAPointLiesOn) {
    Triangulation mesh(square);
    EXPECT_EQ(mesh.insert({0.5, 0.0}), 4);  // on the outline: one triangle becomes two
    EXPECT_EQ(mesh.triangles().size(), 3u);
    EXPECT_TRUE(has_edge(mesh, 0, 4));
    EXPECT_TRUE(has_edge(mesh, 4, 1));
    EXPECT_FALSE(has_edge(mesh, 0, 1));
    Triangulation crossed(square);
    EXPECT_EQ(crossed.insert({0.5, 0.5}), 4);  // on a diagonal: two become four
    EXPECT_EQ(crossed.triangles().size(), 4u);
    EXPECT_NEAR(area_of(crossed), 1.0, area_rounding);
}

TEST(Triangulation, CutsTheOutlineByItsEndsWhereEveryEdgeIsNear) {
    Triangulation mesh(std::vector<Vec2>{{0, 0}, {1, 0}, {1, 1e-9}});
    EXPECT_EQ(mesh.split_boundary(0, 1, {0.5, 0}), 3);
    EXPECT_EQ(mesh.split_boundary(2, 0, {0.5, 0.5e-9}), 4);
    EXPECT_EQ(mesh.split_boundary(4, 0, {0.25, 0.25e-9}), 5);
    EXPECT_EQ(mesh.split_boundary(2, 0, {0.75, 0.75e-9}), std::nullopt);  // no neighbours any more
    EXPECT_EQ(mesh.triangles().size(), 4u);
    EXPECT_NEAR(area_of(mesh), 0.5e-9, 1e-21);
    EXPECT_FALSE(has_edge(mesh, 2, 0));
}

TEST(Triangulation, PartsOfASplitEdgeOfTheOutlineStayFixed) {
    Triangulation mesh(square);
    mesh.insert({0.5, 0.0});
    int fixed = 0;
    for (const auto& t : mesh.triangles())
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(t.fixed[k], t.across[k] == Triangulation::none);
            fixed += t.fixed[k];
        }
    EXPECT_EQ(fixed, 5);
}

TEST(Triangulation, MakesAnEdgeOfTwoPointsAndKeepsIt) {
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u}) {
        Triangulation mesh(square);
        add_random_points(mesh, 100, seed);
        const int a = *mesh.insert({0.1, 0.15}), b = *mesh.insert({0.93, 0.71});
        mesh.fix_edge(a, b);
        EXPECT_TRUE(is_joined(mesh, a, b));
        add_random_points(mesh, 400, seed + 100);
        EXPECT_TRUE(is_joined(mesh, a, b));
        EXPECT_NEAR(area_of(mesh), 1.0, area_rounding);
        EXPECT_EQ(edges_not_delaunay(mesh), 0);
    }
}

TEST(Triangulation, KeepsEdgesThatCross) {
    Triangulation mesh(square);
    const int a = *mesh.insert({0.1, 0.1}), b = *mesh.insert({0.9, 0.9});
    const int c = *mesh.insert({0.1, 0.9}), d = *mesh.insert({0.9, 0.1});
    mesh.insert({0.5, 0.5});
    mesh.fix_edge(a, b);
    mesh.fix_edge(c, d);
    add_random_points(mesh, 200, 1);
    EXPECT_TRUE(is_joined(mesh, a, b));
    EXPECT_TRUE(is_joined(mesh, c, d));
}

TEST(Triangulation, CutsFixedEdgesOnceWhereAnotherMeetsThem) {
    Triangulation mesh(square);
    const int a = *mesh.insert({0.1, 0.13}), b = *mesh.insert({0.9, 0.81});
    const int c = *mesh.insert({0.1, 0.91}), d = *mesh.insert({0.9, 0.22});
    mesh.fix_edge(a, b);
    const std::size_t before = mesh.points().size();
    mesh.fix_edge(c, d);
    ASSERT_EQ(mesh.points().size(), before + 1);
    const Vec2 meeting = mesh.points().back();
    EXPECT_NEAR(turn({0.1, 0.13}, {0.9, 0.81}, meeting), 0.0, 1e-15);
    EXPECT_NEAR(turn({0.1, 0.91}, {0.9, 0.22}, meeting), 0.0, 1e-15);
    EXPECT_NEAR(area_of(mesh), 1.0, area_rounding);
}

TEST(Triangulation, EdgesThatNearlyCoincideTakeFewPoints) {
    // Halving them until they are apart would take millions.
    for (const double gap : {1e-4, 1e-6, 1e-8, 3e-9, 1e-9}) {
        Triangulation mesh(square);
        add_random_points(mesh, 50, 7);
        const int a = *mesh.insert({0.1, 0.2}), b = *mesh.insert({0.9, 0.7});
        const int c = *mesh.insert({0.1, 0.2 + gap}), d = *mesh.insert({0.9, 0.7 - gap});
        const std::size_t before = mesh.points().size();
        mesh.fix_edge(a, b);
        mesh.fix_edge(c, d);
        EXPECT_LE(mesh.points().size(), before + 2) << gap;
        EXPECT_NEAR(area_of(mesh), 1.0, area_rounding);
    }
}

}  // namespace
}  // namespace patchlight::triangulation_test
