#include "solver/display/likely_field.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patchlight::likely_field_test {
namespace {

struct Measured {
    CutScene pieces;
    RefinementTree tree;
    std::vector<Rgb> exact, values;
    std::vector<double> variance;
    std::vector<bool> known;
    std::vector<Rgb> reflectance;

    double mean_square(const std::vector<Rgb>& found) const {
        double sum = 0.0;
        for (std::size_t v = 0; v < found.size(); ++v)
            sum += std::pow(found[v][0] - exact[v][0], 2) / static_cast<double>(found.size());
        return sum;
    }
    NoisyField field() const { return {values, variance, known, reflectance}; }
};

constexpr double noise = 0.05;

/// A square in four patches, cut evenly into 64 x 64, with normal noise at every vertex.
template <typename Function>
Measured measure(const Function& f) {
    Scene scene = empty_scene();
    add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, white);
    CutScene pieces = cut(scene, 0.51);
    RefinementTree tree(pieces.mesh,
                        find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene)));
    for (int level = 0; level < 5; ++level)
        for (std::uint32_t e = 0, n = static_cast<std::uint32_t>(tree.elements().size()); e < n;
             ++e)
            tree.split(e);
    const std::size_t patches = pieces.mesh.size();
    Measured measured{std::move(pieces), std::move(tree), {}, {}, {}, {}, {}};
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0.0, noise);
    for (const TreeVertex& vertex : measured.tree.vertices()) {
        measured.exact.push_back(Rgb::Constant(f(vertex.position.x(), vertex.position.y())));
        measured.values.push_back(measured.exact.back() + normal(random));
    }
    measured.variance.assign(measured.values.size(), noise * noise);
    measured.known.assign(measured.values.size(), true);
    measured.reflectance.assign(patches, Rgb::Constant(1.0));
    return measured;
}

TEST(LikelyField, SharesRaysBetweenNeighboursWhereItIsSmooth) {
    const Measured measured = measure(
        [](double x, double y) { return 1.0 + 0.5 * std::sin(3.0 * x) * std::cos(2.0 * y); });
    const std::vector<Rgb> found = likely_field(measured.tree, measured.field(), 0.2 * noise);
    // 4225 vertices: the mean square of noise is known to 2 %, so a third is never chance.
    EXPECT_LT(measured.mean_square(found), measured.mean_square(measured.values) / 3.0);
}

TEST(LikelyField, LeavesAnEdgeAsItIs) {
    const auto step = [](double x, double y) { return x + 0.4 * y < 0.7 ? 1.0 : 0.2; };
    const Measured measured = measure(step);
    const std::vector<Rgb> found = likely_field(measured.tree, measured.field(), 0.2 * noise);
    EXPECT_LT(measured.mean_square(found), measured.mean_square(measured.values));
    constexpr double of_step = 0.25 * 0.8;  // five standard deviations of the noise are 0.25
    double worst = 0.0;
    for (std::size_t v = 0; v < found.size(); ++v)
        worst = std::max(worst, std::abs(found[v][0] - measured.exact[v][0]));
    EXPECT_LT(worst, of_step + 0.1);
}

TEST(LikelyField, KeepsWhatHasNoNoise) {
    Measured measured = measure([](double x, double y) { return x > y ? 3.0 * x : y * y; });
    measured.values = measured.exact;
    measured.variance.assign(measured.variance.size(), 0.0);
    const std::vector<Rgb> found = likely_field(measured.tree, measured.field(), 0.01);
    EXPECT_LT(measured.mean_square(found), 1e-12);
}

TEST(LikelyField, LeavesWhatWasNotGatheredAlone) {
    Measured measured = measure([](double x, double) { return x; });
    measured.known[7] = false;
    measured.values[7] = Rgb::Constant(77.0);
    const std::vector<Rgb> found = likely_field(measured.tree, measured.field(), 0.01);
    EXPECT_EQ(found[7][0], 77.0);
    EXPECT_LT(found[8][0], 2.0);
}

}  // namespace
}  // namespace patchlight::likely_field_test
