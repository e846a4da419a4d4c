#include "solver/mesh/merge_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::merge_triangles_test {
namespace {

constexpr double rounding = 1e-12;  // areas of some hundred faces

const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

Triangulation lattice(int cells) {
    Triangulation mesh(square);
    for (int i = 0; i <= cells; ++i)
        for (int j = 0; j <= cells; ++j)
            mesh.insert({static_cast<double>(i) / cells, static_cast<double>(j) / cells});
    return mesh;
}

bool is_triangle(const std::array<std::uint32_t, 4>& face) { return face[2] == face[3]; }

TEST(MergeTriangles, MakesSquaresOfALattice) {
    const Triangulation mesh = lattice(8);
    const MergedFaces merged = merge_triangles(mesh);
    EXPECT_EQ(merged.faces.size(), 64u);
    double area = 0.0;
    for (const auto& [a, b, c, d] : merged.faces) {
        const auto& p = mesh.points();
        EXPECT_NEAR((p[b] - p[a]).dot(p[d] - p[a]), 0.0, rounding);
        area += 0.5 * (turn(p[a], p[b], p[c]) + turn(p[a], p[c], p[d]));
    }
    EXPECT_NEAR(area, 1.0, rounding);
}

TEST(MergeTriangles, LeavesFixedEdges) {
    Triangulation mesh(square);
    mesh.fix_edge(0, 2);
    mesh.fix_edge(1, 3);  // one of the two is an edge, the other splits it
    const MergedFaces merged = merge_triangles(mesh);
    EXPECT_EQ(merged.faces.size(), 4u);
    EXPECT_TRUE(std::all_of(merged.faces.begin(), merged.faces.end(), is_triangle));
}

TEST(MergeTriangles, LeavesTrianglesWhoseQuadWouldHaveASharpCorner) {
    const std::vector<Vec2> slanted{{0, 0}, {1, 0}, {2, 1}, {1, 1}};  // corners of 45 degrees
    EXPECT_EQ(merge_triangles(Triangulation(slanted)).faces.size(), 2u);
    const std::vector<Vec2> dart{{0, 0}, {0.5, 0.4}, {1, 0}, {0.5, 1}};
    EXPECT_EQ(merge_triangles(Triangulation(dart)).faces.size(), 2u);
}

TEST(MergeTriangles, PrefersTheMoreRectangularPair) {
    // A square with a roof: of its triangles the two of the square are joined.
    const std::vector<Vec2> house{{0, 0}, {1, 0}, {1, 1}, {0.5, 1.3}, {0, 1}};
    const MergedFaces merged = merge_triangles(Triangulation(house));
    ASSERT_EQ(merged.faces.size(), 2u);
    EXPECT_FALSE(is_triangle(merged.faces[0]));
    EXPECT_TRUE(is_triangle(merged.faces[1]));
    EXPECT_EQ(std::count(merged.faces[0].begin(), merged.faces[0].end(), 3u), 0);
}

}  // namespace
}  // namespace patchlight::merge_triangles_test
