#include "solver/display/curved_mean.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace patchlight::curved_mean_test {
namespace {

constexpr double rounding = 1e-12;

struct Cut {
    CutScene pieces;
    RefinementTree tree;
};

/// Every element of a patch of these corners cut `levels` times.
Cut cut_evenly(const std::vector<Vec3>& corners, int levels) {
    Scene scene = empty_scene();
    add(scene, corners, white);
    CutScene pieces = cut(scene, 100.0);
    RefinementTree tree(pieces.mesh,
                        find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene)));
    for (int level = 0; level < levels; ++level)
        for (std::uint32_t e = 0, n = static_cast<std::uint32_t>(tree.elements().size()); e < n;
             ++e)
            tree.split(e);
    return {std::move(pieces), std::move(tree)};
}

using Function = std::function<double(double, double)>;

double at(const Function& f, const TreeVertex& vertex) {
    return f(vertex.position.x(), vertex.position.y());
}

/// Largest difference between a function and what is expected at vertices between others, below
/// the first level, where rows are known.
double largest_miss(const RefinementTree& tree, const Function& f) {
    std::vector<Rgb> values;
    for (const TreeVertex& vertex : tree.vertices()) values.push_back(Rgb::Constant(at(f, vertex)));
    double most = 0.0;
    int looked_at = 0;
    for (const TreeVertex& vertex : tree.vertices()) {
        if (!vertex.row && vertex.parent_count != 4) continue;
        most = std::max(most, std::abs(curved_mean(tree, vertex, values)[0] - at(f, vertex)));
        ++looked_at;
    }
    EXPECT_GT(looked_at, 10);
    return most;
}

double parabola(double x, double y) { return 5.0 + 2.0 * x + y - 0.3 * x * x - 0.2 * y * y; }

TEST(CurvedMean, IsExactOnAParabolaOverAQuad) {
    const Cut cut = cut_evenly({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 3);
    EXPECT_LT(largest_miss(cut.tree, parabola), rounding);
}

TEST(CurvedMean, IsExactOnAParabolaOverATriangle) {
    const Cut cut = cut_evenly({{0, 0, 0}, {1, 0, 0}, {0.3, 1, 0}}, 3);
    EXPECT_LT(largest_miss(cut.tree, parabola), rounding);
}

TEST(CurvedMean, HardlySwingsBesideAStep) {
    const Cut cut = cut_evenly({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 4);
    const Function step = [](double x, double) { return x < 0.53 ? 1.0 : 0.0; };
    std::vector<Rgb> values;
    for (const TreeVertex& vertex : cut.tree.vertices())
        values.push_back(Rgb::Constant(at(step, vertex)));
    constexpr double hundredth = 0.0101;
    for (const TreeVertex& vertex : cut.tree.vertices()) {
        if (!vertex.row) continue;
        const double a = values[vertex.parents[0]][0], b = values[vertex.parents[1]][0];
        if (a != b) continue;
        EXPECT_NEAR(curved_mean(cut.tree, vertex, values)[0], a, hundredth);
    }
}

TEST(CurvedMean, TakesTheMeanWhereNoRowIsKnown) {
    const Cut cut = cut_evenly({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1);
    std::vector<Rgb> values(cut.tree.vertices().size());
    for (std::size_t v = 0; v < values.size(); ++v)
        values[v] = Rgb::Constant(static_cast<double>(v * v));
    for (const TreeVertex& vertex : cut.tree.vertices()) {
        if (vertex.parent_count != 2) continue;
        EXPECT_NEAR(curved_mean(cut.tree, vertex, values)[0],
                    0.5 * (values[vertex.parents[0]][0] + values[vertex.parents[1]][0]), rounding);
    }
}

}  // namespace
}  // namespace patchlight::curved_mean_test
