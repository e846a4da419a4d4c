#include "solver/accuracy/check_points.h"

#include "solver/form_factors/point_factor.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace patchlight::check_points_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();
constexpr double rho = 0.5;  // of the floor

TEST(MeasuredError, AddsStandardErrorsAndIsNeverBelowNothing) {
    EXPECT_DOUBLE_EQ((MeasuredError{0.04, 0.0, 0.0, 100}.at_most(2.0)), 0.2);
    EXPECT_DOUBLE_EQ((MeasuredError{0.04, 1e-4, 0.0, 100}.at_most(2.0)), std::sqrt(0.06));
    EXPECT_EQ((MeasuredError{-0.04, 1e-4, 0.0, 100}.at_most(1.0)), 0.0);
}

TEST(CheckReport, JoinsTwoSetsOfPointsByTheirNumbers) {
    CheckReport a, b;
    a.indirect = {1.0, 0.3, 2.0, 100};
    b.indirect = {4.0, 0.6, -1.0, 200};
    a.of_object = {{1.0, 0.0, 40}, {0.0, 0.0, 0}};
    b.of_object = {{4.0, 0.0, 80}, {3.0, 0.0, 10}};
    const CheckReport both = joined(a, b);
    EXPECT_NEAR(both.indirect.square, 3.0, 1e-12);
    EXPECT_NEAR(both.indirect.variance, 0.3 / 9 + 0.6 * 4 / 9, 1e-12);
    EXPECT_NEAR(both.indirect.mean, 0.0, 1e-12);
    EXPECT_EQ(both.indirect.points, 300);
    EXPECT_EQ(both.of_object[0].points, 120);
    EXPECT_EQ(both.of_object[1].points, 10);
}

/// A floor under a lamp of its size, half of which a plate may hide, and what is shown of it.
struct Floor {
    CutScene pieces;
    RayScene rays;
    PatchLocator locator;
    ReflectedField dark;
    PointGather gather;
    VertexGather points;
    RefinementTree tree;

    explicit Floor(bool half_hidden)
        : pieces(cut(make(half_hidden), 0.05)),
          rays(pieces.scene, pieces.lines.overlaps),
          locator(pieces.scene, pieces.mesh, rays),
          dark(pieces.scene, pieces.mesh, rays, locator, FieldTable(pieces.mesh, {}, rays, {})),
          gather(rays, find_light_sources(pieces.scene, pieces.lines, rays, 10), 1 << 12),
          points(pieces.scene, pieces.mesh, rays, find_plane_groups(pieces.scene), gather, 1, {}),
          tree(pieces.mesh, find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene))) {}
    static Scene make(bool half_hidden) {
        Scene scene = scene_of(rectangle(Vec3::Zero(), x, y));
        add(scene, rectangle({0, 1, 1}, x, -y), lamp);
        if (half_hidden) add(scene, rectangle({-1, 0.5, 0.9}, 3 * x, -2 * y), lamp);
        return scene;
    }
    /// What arrives at every vertex, and `more` on the floor.
    TreeDisplay shown(double more, int samples) const {
        SplitIrradiance arriving;
        const std::size_t n = tree.vertices().size();
        std::vector<std::uint32_t> all(n);
        for (std::uint32_t v = 0; v < n; ++v) all[v] = v;
        const auto gathered = points.direct(tree, all, {samples, samples});
        arriving.indirect.assign(n, Rgb::Zero());
        for (std::uint32_t v = 0; v < n; ++v)
            arriving.direct.push_back(
                gathered[v].value +
                (pieces.mesh.patches[tree.vertices()[v].patch].surface == 0 ? more : 0.0));
        return make_tree_display(pieces.scene, pieces.mesh, tree, arriving);
    }
    CheckReport check(const TreeDisplay& display, int samples, std::uint64_t seed) const {
        return check_display(pieces.scene, display, points, dark,
                             {1024, {samples, samples}, 64, 32}, seed);
    }
};

TEST(CheckDisplay, MeasuresWhatIsTooMuch) {
    const Floor floor(false);
    const CheckReport report = floor.check(floor.shown(0.1, 16), 16, 7);
    const double exact = rho * 0.1;  // on one square metre
    EXPECT_NEAR(report.direct.at_most(0.0), exact, 0.02 * exact);
    EXPECT_NEAR(report.direct.mean, exact, 0.02 * exact);
    EXPECT_NEAR(report.of_object[0].square, exact * exact, 0.04 * exact * exact);
    EXPECT_EQ(report.indirect.square, 0.0) << "nothing is reflected, nothing shown";
}

/// The mean of 30 measurements is within 4 standard errors of nothing, but for one run in 16 000;
/// seeds are fixed.
TEST(CheckDisplay, NoiseOfItsOwnHasNoShareInTheMean) {
    const Floor floor(true);
    const TreeDisplay display = floor.shown(0.0, 4096);  // a plate leaves a penumbra
    double sum = 0.0, squares = 0.0, own = 0.0;
    constexpr int runs = 30;
    for (int k = 0; k < runs; ++k) {
        const double coarse = floor.check(display, 16, static_cast<std::uint64_t>(k)).direct.square;
        const double fine = floor.check(display, 1024, static_cast<std::uint64_t>(k)).direct.square;
        sum += coarse - fine;
        squares += (coarse - fine) * (coarse - fine);
        own += fine / runs;
    }
    EXPECT_LT(std::abs(sum), 4.0 * std::sqrt(squares));
    // Shown by vertices of 16 samples, the same noise is an error, but for what interpolation
    // evens.
    const double noise = floor.check(floor.shown(0.0, 16), 1024, 99).direct.square - own;
    EXPECT_GT(noise, 0.0);
    EXPECT_LT(std::abs(sum) / runs, 0.2 * noise);
}

}  // namespace
}  // namespace patchlight::check_points_test
