#include "solver/form_factors/hemicube_cells.h"

#include "solver/form_factors/point_factor.h"
#include "tests/slope.h"
#include "tests/solver/form_factors/polygons.h"
#include "tests/solver/solutions.h"

#include <gtest/gtest.h>

#include <numeric>

namespace patchlight::hemicube_cells_test {
namespace {

constexpr double rounding = 1e-12;
const std::vector<int> resolutions{2, 3, 5, 16, 32, 50, 63, 64, 65, 100, 127, 128};

double five_faces(const HemicubeCells& cells) {
    return std::accumulate(cells.top().begin(), cells.top().end(), 0.0) +
           4.0 * std::accumulate(cells.side().begin(), cells.side().end(), 0.0);
}

std::size_t at(int row, int column, const HemicubeCells& cells) {
    return static_cast<std::size_t>(row * cells.width() + column);
}

/// Exact share of a cell of the top face at z = 1, or of the side face at y = 1.
double exact_share(const HemicubeCells& cells, bool top, int row, int column) {
    const double dx = 2.0 / cells.width(), dy = top ? dx : 1.0 / cells.side_height();
    const double x = -1.0 + column * dx, y = 1.0 - row * dy;
    const auto corner = [&](double u, double v) { return top ? Vec3(u, v, 1.0) : Vec3(u, 1.0, v); };
    const Polygon cell{corner(x, y), corner(x + dx, y), corner(x + dx, y - dy), corner(x, y - dy)};
    const Polygon inwards = top ? cell : reversed(cell);
    return point_factor(Vec3::Zero(), Vec3::UnitZ(), convex(inwards), normal_of(inwards));
}

TEST(HemicubeCells, DeltaFactorsSumToTheKnownTable) {
    const nlohmann::json table = solution_case("s-d17")["sum_of_delta_form_factors"];
    for (const auto& [resolution, sum] : table.items()) {
        const HemicubeCells cells(std::stoi(resolution));
        RecordProperty("raw_sum_" + resolution, std::to_string(cells.raw_sum() - 1.0));
        EXPECT_NEAR(cells.raw_sum(), sum.get<double>(), rounding) << resolution;
    }
    EXPECT_EQ(table.size(), 9u);
}

TEST(HemicubeCells, OfAllFiveFacesSumToOne) {
    for (const int resolution : resolutions)
        EXPECT_NEAR(five_faces(HemicubeCells(resolution)), 1.0, rounding) << resolution;
}

TEST(HemicubeCells, OfAnOddResolutionRoundTheSidesUp) {
    for (const int resolution : resolutions) {
        const HemicubeCells cells(resolution);
        EXPECT_EQ(cells.side_height(), (resolution + 1) / 2);
        EXPECT_EQ(cells.top().size(), static_cast<std::size_t>(resolution * resolution));
        EXPECT_EQ(cells.side().size(), static_cast<std::size_t>(resolution * cells.side_height()));
        EXPECT_EQ(static_cast<std::size_t>(cells.count()),
                  cells.top().size() + 4 * cells.side().size());
    }
}

TEST(HemicubeCells, AreSymmetric) {
    for (const int resolution : resolutions) {
        const HemicubeCells cells(resolution);
        const int last = resolution - 1;
        for (int row = 0; row < resolution; ++row)
            for (int column = 0; column < resolution; ++column) {
                const double share = cells.top()[at(row, column, cells)];
                EXPECT_NEAR(share, cells.top()[at(last - row, column, cells)], rounding * share);
                EXPECT_NEAR(share, cells.top()[at(row, last - column, cells)], rounding * share);
                EXPECT_NEAR(share, cells.top()[at(column, row, cells)], rounding * share);
            }
        for (int row = 0; row < cells.side_height(); ++row)
            for (int column = 0; column < resolution; ++column) {
                const double share = cells.side()[at(row, column, cells)];
                EXPECT_NEAR(share, cells.side()[at(row, last - column, cells)], rounding * share);
            }
    }
}

TEST(HemicubeCells, AreTheExactSharesOfTheirSolidAnglesToSecondOrder) {
    std::vector<double> width, worst;
    for (const int resolution : {16, 31, 64, 127}) {
        const HemicubeCells cells(resolution);
        double largest = 0.0, sum = 0.0;
        for (const bool top : {true, false})
            for (int row = 0; row < (top ? resolution : cells.side_height()); ++row)
                for (int column = 0; column < resolution; ++column) {
                    const double exact = exact_share(cells, top, row, column);
                    const double share = (top ? cells.top() : cells.side())[at(row, column, cells)];
                    sum += (top ? 1.0 : 4.0) * exact;
                    // Of the brightest cell of the face: those at the horizon are next to nothing.
                    largest = std::max(largest, std::abs(share - exact) * resolution * resolution);
                }
        EXPECT_NEAR(sum, 1.0, 1e-10) << resolution;
        width.push_back(2.0 / resolution);
        worst.push_back(largest);
    }
    const Slope slope = fit_slope(width, worst);
    RecordProperty("slope", std::to_string(slope.value));
    RecordProperty("worst_at_64", std::to_string(worst[2]));
    EXPECT_NEAR(slope.value, 2.0, 0.1) << "midpoint rule";
    EXPECT_LT(worst[2], 1e-3) << "of a share of about 1 in resolution squared";
}

}  // namespace
}  // namespace patchlight::hemicube_cells_test
