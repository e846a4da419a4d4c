#include "solver/display/irradiance_layer.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace patchlight::irradiance_layer_test {
namespace {

using Gathered = IrradianceLayer::Gathered;

struct Square {
    CutScene pieces;
    RefinementTree tree;
    std::vector<Rgb> reflectance;

    Square() : pieces(cut(one(), 0.51)), tree(pieces.mesh, corners(pieces)) {
        reflectance.assign(pieces.mesh.size(), Rgb::Constant(0.5));
    }
    static Scene one() {
        Scene scene = empty_scene();
        add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, white);
        return scene;
    }
    static FlatCorners corners(const CutScene& pieces) {
        return find_flat_corners(pieces.mesh, find_plane_groups(pieces.scene));
    }
};

template <typename Function>
IrradianceLayer::Gather gatherer(const RefinementTree& tree, const Function& f) {
    return [&tree, f](std::span<const std::uint32_t> vertices) {
        std::vector<Gathered> values;
        for (const std::uint32_t v : vertices) {
            const Vec3& p = tree.vertices()[v].position;
            values.push_back({Rgb::Constant(f(p.x(), p.y())), 0.0, true});
        }
        return values;
    };
}

/// Root of the mean square of what bilinear leaves miss, times the reflectance.
template <typename Function>
double true_miss(const Square& square, const std::vector<Rgb>& values, const Function& f) {
    double sum = 0.0;
    constexpr int n = 8;
    for (const TreeElement& element : square.tree.elements()) {
        if (!element.is_leaf()) continue;
        for (int k = 0; k < n * n; ++k) {
            const double a = (k % n + 0.5) / n, b = (k / n + 0.5) / n;
            const std::array<double, 4> w{(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b};
            Vec3 p = Vec3::Zero();
            double value = 0.0;
            for (std::size_t c = 0; c < 4; ++c) {
                p += w[c] * square.tree.vertices()[element.vertices[c]].position;
                value += w[c] * values[element.vertices[c]][0];
            }
            const double miss = 0.5 * (value - f(p.x(), p.y()));
            sum += element.area * miss * miss / (n * n);
        }
    }
    return std::sqrt(sum);
}

/// Two levels more, so that what bends between gathered vertices is nearly shown.
void show_bends(RefinementTree& tree) {
    for (int level = 0; level < 2; ++level)
        for (std::uint32_t e = 0, n = static_cast<std::uint32_t>(tree.elements().size()); e < n;
             ++e)
            tree.split(e);
}

TEST(IrradianceLayer, FollowsARidgeThatOnlyPointsBetweenItsVerticesTold) {
    const auto f = [](double, double y) {
        return 1.0 + 5.0 * std::exp(-std::pow((y - 0.33) / 0.012, 2));
    };
    Square square;
    IrradianceLayer layer(square.tree.vertices().size());
    IrradianceLayer::Rule rule;
    rule.target = 0.1;
    const auto gather = gatherer(square.tree, f);
    ASSERT_TRUE(layer.refine(square.tree, square.reflectance, rule, gather));
    const auto peak_at = [&](double x) {  // the most that is shown near x on the ridge
        const std::vector<Rgb> values = layer.at_all(square.tree);
        double most = 0.0;
        for (std::size_t v = 0; v < values.size(); ++v)
            if (std::abs(square.tree.vertices()[v].position.x() - x) < 0.07)
                most = std::max(most, values[v][0]);
        return most;
    };
    ASSERT_LT(peak_at(0.5), 2.0) << "the ridge lies between vertices";
    CloserLook closer(square.pieces.scene, square.pieces.mesh, square.tree);
    std::vector<PointMiss> points;
    for (const double x : {0.1, 0.4, 0.6, 0.9})
        points.push_back(
            {square.pieces.mesh.first_of_surface[0], Vec3(x, 0.33, 0), 6.25, Rgb::Constant(6.0)});
    for (PointMiss& point : points) {  // the patch it is in
        for (PatchIndex i = 0; i < square.pieces.mesh.size(); ++i)
            if ((square.pieces.mesh.patches[i].centre - point.position).cwiseAbs().maxCoeff() <=
                0.25)
                point.patch = i;
    }
    closer.add(square.tree, points,
               [&](const TreeElement& element) { return layer.is_cut(square.tree, element); });
    rule.closer = &closer;
    rule.follow = true;
    const std::size_t before = layer.gathered();
    ASSERT_TRUE(layer.refine(square.tree, square.reflectance, rule, gather));
    for (const double x : {0.1, 0.5, 0.9}) EXPECT_GT(peak_at(x), 2.0) << x;
    EXPECT_LT(layer.gathered(), before + 1000) << "about the ridge alone";
}

TEST(IrradianceLayer, ReachesItsTargetOnASmoothField) {
    const auto f = [](double x, double y) { return 1.0 + std::exp(-8.0 * (x * x + y * y)); };
    for (const double target : {1e-2, 1e-3, 1e-4}) {
        Square square;
        IrradianceLayer layer(square.tree.vertices().size());
        IrradianceLayer::Rule rule;
        rule.target = target;
        EXPECT_TRUE(layer.refine(square.tree, square.reflectance, rule, gatherer(square.tree, f)));
        EXPECT_LE(layer.expected_miss(), target);
        show_bends(square.tree);
        const double found = true_miss(square, layer.at_all(square.tree), f);
        EXPECT_LE(found, 1.5 * target);
        EXPECT_GE(found, target / 50.0) << "no more vertices than are needed";
    }
}

TEST(IrradianceLayer, FollowsAnEdgeThatItFound) {
    // A thin bright line that passes between most probes.
    const auto f = [](double x, double y) {
        const double off = (y - 0.3 * x - 0.31) / 0.01;
        return 1.0 + 3.0 * std::exp(-off * off);
    };
    double missed[2];
    for (const bool follow : {false, true}) {
        Square square;
        IrradianceLayer layer(square.tree.vertices().size());
        IrradianceLayer::Rule rule;
        rule.target = 0.04;
        rule.follow = follow;
        layer.refine(square.tree, square.reflectance, rule, gatherer(square.tree, f));
        missed[follow] = true_miss(square, layer.at_all(square.tree), f);
    }
    EXPECT_LE(missed[true], missed[false]);
}

TEST(IrradianceLayer, JoinsSamplesToThoseThereAre) {
    Square square;
    IrradianceLayer layer(square.tree.vertices().size());
    IrradianceLayer::Rule rule;
    rule.target = 1.0;
    const auto all = [](double value) {
        return [value](std::span<const std::uint32_t> vertices) {
            return std::vector<Gathered>(vertices.size(), {Rgb::Constant(value), 0.04, true});
        };
    };
    layer.refine(square.tree, square.reflectance, rule, all(1.0));
    const double before = layer.noise(square.tree);
    EXPECT_TRUE(layer.join(all(3.0), 0.75));
    for (const Rgb& value : layer.at_all(square.tree)) EXPECT_NEAR(value[0], 2.5, 1e-12);
    // Both parts tell the variance of the whole: 4 times, and 4/3 times as many samples.
    const double less = 0.5 * (std::pow(0.25, 1.44) + std::pow(0.75, 1.44));
    EXPECT_NEAR(layer.noise(square.tree), before * std::sqrt(less), 1e-9);
}

TEST(IrradianceLayer, CutsWhatMustBeLookedAt) {
    Square square;
    IrradianceLayer layer(square.tree.vertices().size());
    IrradianceLayer::Rule rule;
    rule.target = 1.0;
    rule.must_cut = [](const TreeElement& element) { return element.area > 1.0 / 100.0; };
    layer.refine(square.tree, square.reflectance, rule,
                 gatherer(square.tree, [](double, double) { return 1.0; }));
    for (const TreeElement& element : square.tree.elements())
        EXPECT_TRUE(!element.is_leaf() || element.area <= 1.0 / 100.0);
    EXPECT_EQ(layer.gathered(), 17u * 17u) << "and no more";
}

TEST(IrradianceLayer, RefinesAlongAnEdgeAndNotBesideIt) {
    const auto f = [](double x, double y) { return x + 0.37 * y < 0.6 ? 1.0 : 2.0; };
    Square square;
    IrradianceLayer layer(square.tree.vertices().size());
    IrradianceLayer::Rule rule;
    rule.target = 0.005;
    layer.refine(square.tree, square.reflectance, rule, gatherer(square.tree, f));
    double far_from = 0.0;
    int deep = 0;
    for (const TreeElement& element : square.tree.elements()) {
        if (element.level < 4) continue;
        const Vec3& p = square.tree.vertices()[element.vertices[0]].position;
        far_from = std::max(far_from, std::abs(p.x() + 0.37 * p.y() - 0.6));
        ++deep;
    }
    EXPECT_GT(deep, 20);
    EXPECT_LT(far_from, 0.2);
}

TEST(IrradianceLayer, DoesNotRefineNoiseThatItIsToldOf) {
    constexpr double noise = 0.05;
    Square square;
    IrradianceLayer layer(square.tree.vertices().size());
    std::mt19937 random(1);
    std::normal_distribution<double> normal(0.0, noise);
    const auto gather = [&](std::span<const std::uint32_t> vertices) {
        std::vector<Gathered> values;
        for (std::size_t k = 0; k < vertices.size(); ++k)
            values.push_back({Rgb::Constant(1.0 + normal(random)), 0.25 * noise * noise, true});
        return values;
    };
    IrradianceLayer::Rule rule;
    rule.target = 0.004;  // a sixth of the noise in what is reflected
    layer.refine(square.tree, square.reflectance, rule, gather);
    EXPECT_LT(layer.gathered(), 2000u);
}

TEST(IrradianceLayer, LooksBetweenCornersThatAreAlike) {
    // A spot in the middle of the square, far from every corner of the roots.
    const auto f = [](double x, double y) {
        return 1.0 + 5.0 * std::exp(-200.0 * ((x - 0.26) * (x - 0.26) + (y - 0.24) * (y - 0.24)));
    };
    Square square;
    IrradianceLayer layer(square.tree.vertices().size());
    IrradianceLayer::Rule rule;
    rule.target = 0.005;
    layer.refine(square.tree, square.reflectance, rule, gatherer(square.tree, f));
    EXPECT_LT(true_miss(square, layer.at_all(square.tree), f), 0.01);
}

TEST(IrradianceLayer, KeepsWhatItHasWhenItIsStopped) {
    Square square;
    IrradianceLayer layer(square.tree.vertices().size());
    const auto every_other = [](std::span<const std::uint32_t> vertices) {
        std::vector<Gathered> values(vertices.size());
        for (std::size_t k = 0; k < vertices.size(); k += 2)
            values[k] = {Rgb::Constant(3.0), 0.0, true};
        return values;
    };
    EXPECT_FALSE(layer.refine(square.tree, square.reflectance, {}, every_other));
    int known = 0;
    for (std::uint32_t v = 0; v < square.tree.vertices().size(); ++v) known += layer.known(v);
    EXPECT_EQ(static_cast<std::size_t>(known), layer.gathered());
    EXPECT_GT(known, 0);
    EXPECT_TRUE(layer.lacks_roots());
}

}  // namespace
}  // namespace patchlight::irradiance_layer_test
