#include "solver/form_factors/contour_exchange.h"

#include "solver/scene/polygon.h"
#include "tests/solver/form_factors/closed_forms.h"
#include "tests/solver/form_factors/polygons.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <string>

namespace patchlight::contour_exchange_test {
namespace {

constexpr double promised = 1e-9;  // relative error of the contour integral
constexpr double rounding = 1e-12;

double area(const Polygon& polygon) { return vector_area(polygon).norm(); }

double factor(const Polygon& p, const Polygon& q) {
    return contour_exchange(convex(p), convex(q)) / area(p);
}

Polygon strip(double depth) { return rectangle(Vec3::Zero(), Vec3(depth, 0, 0), Vec3(0, 1, 0)); }
Polygon wall() { return rectangle(Vec3::Zero(), Vec3(0, 1, 0), Vec3(0, 0, 1)); }

/// Exact factors; Howell, "A Catalog of Radiation Configuration Factors", 1982, by number.
struct KnownFactor {
    std::string name;
    Polygon from, to;
    double exact;
    friend std::ostream& operator<<(std::ostream& out, const KnownFactor& known) {
        return out << known.name;
    }
};

std::vector<KnownFactor> known_factors() {
    const Polygon unit = rectangle(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0));
    return {{"c11_unit_squares",
             unit,
             {{0, 1, 1}, {1, 1, 1}, {1, 0, 1}, {0, 0, 1}},
             0.199824895698387383},
            {"c11_close_rectangles",
             rectangle(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 3, 0)),
             {{0, 3, 0.5}, {2, 3, 0.5}, {2, 0, 0.5}, {0, 0, 0.5}},
             0.679537091656778598},
            {"c14_common_edge",
             unit,
             {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}},
             0.200043776075403154},
            {"c14_long_common_edge",
             rectangle(Vec3::Zero(), Vec3(3, 0, 0), Vec3(0, 2, 0)),
             {{0, 0, 0}, {0, 2, 0}, {0, 2, 0.5}, {0, 0, 0.5}},
             0.0627963581976321887},
            {"c13_offset",
             rectangle(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 1, 0)),
             {{1.5, -1, 1.25}, {1.5, 0.5, 1.25}, {4, 0.5, 1.25}, {4, -1, 1.25}},
             0.117942609910993863},
            {"c15_offset",
             rectangle(Vec3(0.5, 0, 0), Vec3(1.5, 0, 0), Vec3(0, 1, 0)),
             {{0, -0.5, 0.25}, {0, 0.75, 0.25}, {0, 0.75, 1.5}, {0, -0.5, 1.5}},
             0.0794678425627307386},
            {"tetrahedron",
             {{-1, 1, -1}, {1, -1, -1}, {1, 1, 1}},
             {{1, -1, -1}, {-1, -1, 1}, {1, 1, 1}},
             1.0 / 3.0}};
}

class KnownFactors : public testing::TestWithParam<KnownFactor> {};

TEST_P(KnownFactors, AreMetBothWays) {
    const auto& [name, from, to, exact] = GetParam();
    EXPECT_NEAR(factor(from, to), exact, promised * exact);
    const double backwards = exact * area(from) / area(to);
    EXPECT_NEAR(factor(to, from), backwards, promised * backwards);
}

TEST_P(KnownFactors, AreMetAtAnyScaleAndPlace) {
    const auto& [name, from, to, exact] = GetParam();
    for (const Motion& motion :
         {Motion{1e-4, Vec3(3e-4, 0, 0), odd_turn()}, Motion{1e6, Vec3(-1e7, 1e7, 0), odd_turn()}})
        EXPECT_NEAR(factor(moved(from, motion), moved(to, motion)), exact, promised * exact);
}

INSTANTIATE_TEST_SUITE_P(ContourExchange, KnownFactors, testing::ValuesIn(known_factors()),
                         [](const auto& known) { return known.param.name; });

TEST(ContourExchange, CoaxialDisksOf64Corners) {
    double exchange = 0.0;
    const Polygon from = regular(64, 1.0), to = reversed(regular(64, 2.0, 1.0));
    for (const ConvexPolygon& p : fan(from))
        for (const ConvexPolygon& q : fan(to)) exchange += contour_exchange(p, q);
    const double exact = 0.763657311094458151;  // C-41 made of polygons, by mpmath quadrature
    EXPECT_NEAR(exchange / area(from), exact, promised * exact);
}

TEST(ContourExchange, PlatesThatNearlyTouch) {
    const Polygon lower = rectangle(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0));
    for (const double gap : {1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
        const Polygon upper = rectangle(Vec3(0, 0, gap), Vec3(0, 1, 0), Vec3(1, 0, 0));
        const double exact = parallel_rectangles(1, 1, gap);
        EXPECT_NEAR(factor(lower, upper), exact, promised * exact) << gap;
    }
}

TEST(ContourExchange, NarrowStripsBesideARightAngle) {
    for (const double depth : {1.0, 0.25, 0.1, 1.0 / 16}) {
        const double exact = perpendicular_rectangles(1, depth, 1);
        EXPECT_NEAR(factor(strip(depth), wall()), exact, promised * exact) << depth;
    }
}

TEST(ContourExchange, NeedlesBesideARightAngle) {
    // The error is 1e-11 of the edges' product: relative to a needle's exchange it is more.
    const double of_needles = 1e-7;
    for (const double depth : {1e-2, 1e-3, 1e-4}) {
        const double exact = perpendicular_rectangles(1, depth, 1);
        EXPECT_NEAR(factor(strip(depth), wall()), exact, of_needles * exact) << depth;
    }
}

TEST(ContourExchange, SquaresThatShareAnEdgeAtAnyAngle) {
    const double quadrature = 3e-9;  // tanh–sinh towards the corners of the common edge, relative
    const Polygon floor = rectangle(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0));
    for (const double degrees : {10.0, 30.0, 45.0, 60.0, 75.0, 100.0, 120.0, 150.0, 170.0}) {
        const double angle = degrees / 180.0 * std::numbers::pi;
        const Polygon leaf =
            rectangle(Vec3::Zero(), Vec3(0, 1, 0), Vec3(std::cos(angle), 0, std::sin(angle)));
        const double expected = exchange_by_quadrature(floor, leaf);
        EXPECT_NEAR(contour_exchange(convex(floor), convex(leaf)), expected, quadrature * expected)
            << degrees;
    }
}

TEST(ContourExchange, PatchesThatShareACornerOnly) {
    const double quadrature = 3e-9;
    const Polygon floor = rectangle(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0)),
                  facing = rectangle(Vec3::Zero(), Vec3(0, 0, 1), Vec3(0, -1, 0));
    const double expected = exchange_by_quadrature(floor, facing);
    EXPECT_NEAR(contour_exchange(convex(floor), convex(facing)), expected, quadrature * expected);
}

TEST(ContourExchange, DoesNotDependOnTheOrderOfThePair) {
    std::mt19937 chance(1);
    int pairs = 0;
    for (int n = 0; n < 2000; ++n) {
        const Polygon p = random_facet(chance);
        const double distance = 1.0 + 5.0 * uniform(chance),
                     size = std::pow(10.0, -uniform(chance));
        const Polygon q = moved(random_facet(chance), {size, distance * random_direction(chance)});
        if (!face_each_other(p, q)) continue;
        const double forth = contour_exchange(convex(p), convex(q));
        EXPECT_NEAR(contour_exchange(convex(q), convex(p)), forth, promised * forth);
        ++pairs;
    }
    EXPECT_GT(pairs, 200);
}

TEST(ContourExchange, TwoHalvesMakeAWhole) {
    const Polygon floor = rectangle(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0));
    const auto part = [](double from, double to) {
        return convex(rectangle(Vec3(0, from, 0), Vec3(0, to - from, 0), Vec3(0, 0, 1)));
    };
    for (const double at : {0.5, 0.1, 0.01}) {
        const double sum = contour_exchange(convex(floor), part(0, at)) +
                           contour_exchange(convex(floor), part(at, 1));
        EXPECT_NEAR(sum, contour_exchange(convex(floor), part(0, 1)), promised) << at;
    }
}

TEST(ContourExchange, TakesRepeatedCorners) {
    const Polygon floor = rectangle(Vec3::Zero(), Vec3(1, 0, 0), Vec3(0, 1, 0));
    Polygon repeated = wall();
    repeated.push_back(repeated.back());
    EXPECT_NEAR(factor(floor, repeated), 0.200043776075403154, rounding);
}

}  // namespace
}  // namespace patchlight::contour_exchange_test
