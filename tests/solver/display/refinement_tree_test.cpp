#include "solver/display/refinement_tree.h"

#include "solver/display/tree_display.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <random>

namespace patchlight::refinement_tree_test {
namespace {

constexpr double rounding = 1e-12;

struct Grown {
    CutScene cut;
    RefinementTree tree;
};

Grown grow(const Scene& scene, double patch_size, int splits, unsigned seed) {
    CutScene pieces = cut(scene, patch_size);
    RefinementTree tree(pieces.mesh,
                        find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene)));
    std::mt19937 random(seed);
    for (int k = 0; k < splits; ++k)
        tree.split(static_cast<std::uint32_t>(random() % tree.elements().size()));
    return {std::move(pieces), std::move(tree)};
}

Scene two_shapes() {
    Scene scene = empty_scene();
    add(scene, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, white);
    add(scene, {{0, 0, 1}, {3, 0, 1}, {1, 2, 1}}, white);
    return scene;
}

double leaf_area(const RefinementTree& tree) {
    double area = 0.0;
    for (const TreeElement& element : tree.elements())
        if (element.is_leaf()) area += element.area;
    return area;
}

TEST(RefinementTree, LeavesKeepTheArea) {
    const Grown grown = grow(two_shapes(), 0.7, 60, 1);
    EXPECT_NEAR(leaf_area(grown.tree), 5.0, rounding);
}

TEST(RefinementTree, SharesVerticesBetweenNeighbours) {
    Grown grown = grow(two_shapes(), 10.0, 0, 1);
    ASSERT_EQ(grown.tree.elements().size(), 2u);
    grown.tree.split(0);  // a quad: 4 corners, 4 middles, 1 centre
    EXPECT_EQ(grown.tree.vertices().size(), 4u + 3u + 5u);
    const std::uint32_t first = grown.tree.elements()[0].first_child;
    grown.tree.split(first);
    grown.tree.split(first + 1);  // shares one middle with its neighbour
    EXPECT_EQ(grown.tree.vertices().size(), 12u + 5u + 4u);
}

TEST(RefinementTree, ParentsComeBeforeTheVerticesBetweenThem) {
    const Grown grown = grow(two_shapes(), 0.7, 200, 2);
    for (std::uint32_t v = 0; v < grown.tree.vertices().size(); ++v) {
        const TreeVertex& vertex = grown.tree.vertices()[v];
        Vec3 mean = Vec3::Zero();
        for (std::uint8_t k = 0; k < vertex.parent_count; ++k) {
            EXPECT_LT(vertex.parents[k], v);
            mean += grown.tree.vertices()[vertex.parents[k]].position / vertex.parent_count;
        }
        if (vertex.parent_count == 0) continue;
        EXPECT_LT((mean - vertex.position).norm(), rounding);
    }
}

TEST(RefinementTree, BalanceLeavesNoEdgeCutInMoreThanTwo) {
    Grown grown = grow(two_shapes(), 10.0, 0, 1);
    std::uint32_t deep = 0;
    for (int level = 0; level < 6; ++level) {
        grown.tree.split(deep);
        deep = grown.tree.elements()[deep].first_child + 2;
    }
    EXPECT_FALSE(grown.tree.balance().empty());
    EXPECT_TRUE(grown.tree.balance().empty());
    EXPECT_NEAR(leaf_area(grown.tree), 5.0, rounding);
}

/// Every inner edge has a triangle on either side, and the areas add up: no crack, no overlap.
TEST(RefinementTree, DisplaysWithoutCracks) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        Grown grown = grow(two_shapes(), 0.7, 120, seed);
        grown.tree.balance();
        const std::vector<Rgb> zero(grown.tree.vertices().size(), Rgb::Zero());
        const TreeDisplay shown =
            make_tree_display(grown.cut.scene, grown.cut.mesh, grown.tree, {zero, zero});
        double area = 0.0;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const auto& t : shown.display.triangles) {
            const auto& p = shown.display.positions;
            area += 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).z();
            for (std::size_t k = 0; k < 3; ++k) ++edges[std::minmax(t[k], t[(k + 1) % 3])];
        }
        EXPECT_NEAR(area, 5.0, rounding);
        double outline = 0.0;
        for (const auto& [edge, count] : edges) {
            EXPECT_LE(count, 2);
            if (count == 1)
                outline +=
                    (shown.display.positions[edge.first] - shown.display.positions[edge.second])
                        .norm();
        }
        const double triangle = 3.0 + std::hypot(2.0, 2.0) + std::hypot(1.0, 2.0);
        EXPECT_NEAR(outline, 6.0 + triangle, 1e-9) << "edges with one triangle are the outline";
    }
}

TEST(RefinementTree, DisplaysLinearFieldsExactly) {
    Grown grown = grow(two_shapes(), 0.7, 120, 5);
    grown.tree.balance();
    std::vector<Rgb> field;
    for (const TreeVertex& vertex : grown.tree.vertices())
        field.push_back(Rgb::Constant(1.0 + vertex.position.x() + 2.0 * vertex.position.y()));
    const std::vector<Rgb> zero(field.size(), Rgb::Zero());
    const TreeDisplay shown =
        make_tree_display(grown.cut.scene, grown.cut.mesh, grown.tree, {field, zero});
    const SplitIrradiance means = patch_means(shown, grown.cut.mesh.size());
    for (PatchIndex i = 0; i < grown.cut.mesh.size(); ++i) {
        const Vec3& c = grown.cut.mesh.patches[i].centre;
        EXPECT_NEAR(means.direct[i][0], 1.0 + c.x() + 2.0 * c.y(), 1e-9);
        EXPECT_EQ(means.indirect[i][0], 0.0);
    }
}

}  // namespace
}  // namespace patchlight::refinement_tree_test
