#include "solver/display/field_table.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace patchlight::field_table_test {
namespace {

constexpr double rounding = 1e-5;  // of single precision

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

Rgb linear(const Vec3& p) { return {5.0 + p.x() - 2.0 * p.y(), 7.0 + p.y(), 3.0 - p.x()}; }

/// A polygon in one patch, shown by an n x n grid of squares in two triangles each, or by itself
/// if it is a triangle or n is 0.
struct Shown {
    CutScene pieces;
    RayScene rays;
    DisplayMesh display;
    std::vector<Rgb> values;

    explicit Shown(const Polygon& polygon, std::uint32_t n = 1)
        : pieces(cut(scene_of(polygon), 9.0)), rays(pieces.scene, pieces.lines.overlaps) {
        if (polygon.size() == 3 || n == 0) {
            for (const Vec3& corner : polygon) add(corner);
            display.triangles = {{0, 1, 2}};
            if (polygon.size() == 4) display.triangles.push_back({0, 2, 3});
        } else {
            const auto number = [n](std::uint32_t i, std::uint32_t j) { return j * (n + 1) + i; };
            for (std::uint32_t j = 0; j <= n; ++j)
                for (std::uint32_t i = 0; i <= n; ++i)
                    add(polygon[0] + (polygon[1] - polygon[0]) * (double{1} * i / n) +
                        (polygon[3] - polygon[0]) * (double{1} * j / n));
            for (std::uint32_t j = 0; j < n; ++j)
                for (std::uint32_t i = 0; i < n; ++i) {
                    display.triangles.push_back(
                        {number(i, j), number(i + 1, j), number(i + 1, j + 1)});
                    display.triangles.push_back(
                        {number(i, j), number(i + 1, j + 1), number(i, j + 1)});
                }
        }
        display.patch.assign(display.triangles.size(), 0);
    }
    void add(const Vec3& p) {
        display.positions.push_back(p);
        values.push_back(linear(p));
    }
    FieldTable table() const { return {pieces.mesh, display, rays, values}; }

    double worst(const FieldTable& table, const Rgb& more = Rgb::Zero()) const {
        double worst = 0.0;
        for (std::size_t c = table.first_cell(0); c < table.end_cell(0); ++c) {
            const FieldTable::Spot spot = table.spot(0, c, 0.5f, 0.5f);
            if (pieces.mesh.patches[0].is_triangle() && !spot.on_patch) continue;
            const Rgb expected = linear(rays.from_ray_space(spot.position.cast<double>())) + more;
            for (std::size_t k = 0; k < 3; ++k)
                worst = std::max(worst, std::abs(static_cast<double>(table.value(c)[k]) -
                                                 expected[static_cast<Eigen::Index>(k)]));
        }
        return worst;
    }
};

const Polygon plate = rectangle({0.3, 0.2, 0.1}, 2 * x + 0.3 * y, 1.5 * y);

TEST(FieldTable, HoldsTheFieldInTheMiddleOfItsCells) {
    for (const std::uint32_t n : {1u, 3u, 40u}) {
        const Shown shown(plate, n);
        EXPECT_LT(shown.worst(shown.table()), rounding) << n;
    }
    const Shown triangle(flat({{0, 0}, {1, 0}, {0.3, 0.9}}));
    EXPECT_LT(triangle.worst(triangle.table()), rounding);
}

TEST(FieldTable, ATrapezoidIsFilledWholeAndSampledByArea) {
    // What triangles are cut into. Points of all its cells that lie on it have its area.
    for (const std::size_t first : {0u, 1u, 2u, 3u}) {
        Polygon corners = flat({{0, 0}, {0.5, 0}, {1.0, 0.8}, {0, 0.8}});
        std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(first),
                    corners.end());
        const Shown shown(corners, 0);
        const FieldTable table = shown.table();
        double inside = 0.0, wrong = 0.0;
        constexpr int n = 4;  // points of a cell, along each direction
        for (std::size_t c = table.first_cell(0); c < table.end_cell(0); ++c)
            for (int k = 0; k < n * n; ++k) {
                const auto spot = table.spot(0, c, (static_cast<float>(k % n) + 0.5f) / n,
                                             (static_cast<float>(k / n) + 0.5f) / n);
                if (!spot.on_patch) continue;
                inside += table.cell_area(0) / (n * n);
                const RayPoint& at = spot.position;
                ASSERT_EQ(table.cell(0, at.x(), at.y(), at.z()), c);
                const Rgb expected = linear(shown.rays.from_ray_space(at.cast<double>()));
                wrong = std::max(wrong, std::abs(double{table.value(c)[0]} - expected[0]));
            }
        const double scale = shown.rays.scale();
        EXPECT_NEAR(inside / (scale * scale), 0.6, 0.006) << first;
        EXPECT_LT(wrong, 0.25) << "within a cell or two";
    }
}

TEST(FieldTable, IsAsFineAsTheDisplay) {
    EXPECT_EQ(Shown(plate, 1).table().cells(), 16u * 16u);
    EXPECT_EQ(Shown(plate, 40).table().cells(), 128u * 128u) << "3200 triangles";
}

TEST(FieldTable, FindsTheCellOfAPointAndPointsOfACell) {
    const Shown shown(plate);
    const FieldTable table = shown.table();
    for (std::size_t c = table.first_cell(0); c < table.end_cell(0); c += 7)
        for (const float u : {0.1f, 0.9f}) {
            const RayPoint at = table.spot(0, c, u, 1.0f - u).position;
            EXPECT_EQ(table.cell(0, at.x(), at.y(), at.z()), c);
        }
}

TEST(FieldTable, AddsLinearFields) {
    const Shown shown(plate);
    FieldTable table = shown.table();
    Eigen::Matrix3d slope = Eigen::Matrix3d::Zero();
    table.add_linear(0, Rgb::Constant(2.0), slope);
    EXPECT_LT(shown.worst(table, Rgb::Constant(2.0)), rounding);
    slope(0, 0) = 0.5;  // red along x
    FieldTable sloped = shown.table();
    sloped.add_linear(0, Rgb::Zero(), slope);
    const std::size_t first = sloped.first_cell(0);
    const FieldTable flat_table = shown.table();
    const double change = static_cast<double>(sloped.value(first)[0] - flat_table.value(first)[0]);
    const Vec3 at =
        shown.rays.from_ray_space(sloped.spot(0, first, 0.5f, 0.5f).position.cast<double>());
    EXPECT_NEAR(change, 0.5 * (at - shown.pieces.mesh.patches[0].centre).x(), rounding);
}

}  // namespace
}  // namespace patchlight::field_table_test
