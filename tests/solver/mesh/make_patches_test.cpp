#include "solver/mesh/make_patches.h"

#include "tests/solver/mesh/mesh_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace patchlight::make_patches_test {
namespace {

constexpr double area_rounding = 1e-12;     // sums of some thousand areas, relative
constexpr double length_rounding = 1e-8;    // of an edge that was divided into equal parts
constexpr double outline_rounding = 1e-11;  // sums of some hundred edges, relative
constexpr double height_rounding = 1e-14;   // of points put back into their plane
constexpr int random_points = 400;          // on each surface

struct Shape {
    std::string name;
    Polygon polygon;
    double patch_size;
    friend std::ostream& operator<<(std::ostream& out, const Shape& shape) {
        return out << shape.name;
    }
};

std::vector<Shape> shapes() {
    const std::vector<std::pair<std::string, Polygon>> outlines{
        {"square", flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})},
        {"rectangle", flat({{0, 0}, {2, 0}, {2, 0.7}, {0, 0.7}})},
        {"parallelogram", flat({{0, 0}, {1, 0}, {1.5, 0.8}, {0.5, 0.8}})},
        {"trapezoid", flat({{0, 0}, {1.5, 0}, {1, 1}, {0, 1}})},
        {"kite", flat({{0, 0}, {1, -0.2}, {2, 0}, {1, 1.5}})},
        {"triangle", flat({{0, 0}, {1, 0}, {0.3, 0.9}})},
        {"l", l_shape()},
        {"star", star(5, 0.4)},
        {"thin_star", star(9, 0.15)},
        {"comb", comb(3)},
        {"spiral", spiral(2)},
        {"disk", regular(64, 1.0)},
        {"hexagon", regular(6, 1.0)},
        {"strip", flat({{0, 0}, {1, 0}, {1, 0.0625}, {0, 0.0625}})},
        {"tilted", moved(l_shape(), {1.0, Vec3(3, -2, 5), odd_turn()})}};
    std::vector<Shape> all;
    for (const auto& [name, polygon] : outlines)
        for (const double size : {0.5, 0.13})
            all.push_back({name + (size == 0.5 ? "_coarse" : "_fine"), polygon, size});
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u, 10u, 11u, 12u})
        all.push_back({"random_" + std::to_string(seed),
                       random_outline(seed, 4 + 3 * static_cast<int>(seed)), 0.2});
    all.push_back({"needle", flat({{0, 0}, {1, 0}, {1, 1e-4}, {0, 1e-4}}), 0.1});
    all.push_back({"sharp_triangle", flat({{0, 0}, {1, 0}, {1, 5e-4}}), 0.1});
    return all;
}

class EveryPolygon : public testing::TestWithParam<Shape> {
  protected:
    const CutScene cut_ = cut(scene_of(GetParam().polygon), GetParam().patch_size);
};

TEST_P(EveryPolygon, IsFilledToRounding) { EXPECT_LT(area_error(cut_), area_rounding); }

TEST_P(EveryPolygon, HasNoEdgeLongerThanThePatchSize) {
    EXPECT_LT(longest_edge(cut_), 1.0 + length_rounding);
}

TEST_P(EveryPolygon, HasConvexCounterClockwisePatchesInItsPlane) {
    EXPECT_GT(least_sine(cut_), 0.0);
    EXPECT_LT(worst_height(cut_), height_rounding);
    for (const Patch& patch : cut_.mesh.patches) {
        EXPECT_GT(patch.area, 0.0);
        EXPECT_FALSE(patch.covered);
    }
}

TEST_P(EveryPolygon, HasPatchesThatDoNotOverlap) {
    EXPECT_EQ(points_not_in_one_patch(cut_, 0, random_points, 1), 0);
}

TEST_P(EveryPolygon, HasNoTVertices) {
    EXPECT_EQ(edges_shared_wrongly(cut_, 0), 0u);
    EXPECT_NEAR(excess_outline(cut_, 0), 0.0, outline_rounding);
}

INSTANTIATE_TEST_SUITE_P(MakePatches, EveryPolygon, testing::ValuesIn(shapes()),
                         [](const auto& shape) { return shape.param.name; });

TEST(MakePatches, CutsASquareIntoSquares) {
    const CutScene square = cut(scene_of(flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), 0.25);
    EXPECT_EQ(square.mesh.size(), 16u);
    EXPECT_EQ(square.mesh.grid[0], (std::array<std::uint32_t, 2>{4, 4}));
    EXPECT_NEAR(worst_aspect(square), 1.0, 1e-12);
    EXPECT_EQ(square.mesh.vertices.size(), 25u);
}

TEST(MakePatches, NumbersTheCellsOfAGridRowByRow) {
    const CutScene plate = cut(scene_of(flat({{0, 0}, {3, 0}, {3, 2}, {0, 2}})), 1.0);
    ASSERT_EQ(plate.mesh.grid[0], (std::array<std::uint32_t, 2>{3, 2}));
    for (PatchIndex i = 0; i < 6; ++i) {
        const Vec3 centre(i % 3 + 0.5, i / 3 + 0.5, 0.0);
        EXPECT_LT((plate.mesh.patches[i].centre - centre).norm(), 1e-12) << i;
    }
}

TEST(MakePatches, LeavesASmallPolygonWhole) {
    EXPECT_EQ(cut(scene_of(flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}})), 2.0).mesh.size(), 1u);
    const CutScene triangle = cut(scene_of(flat({{0, 0}, {1, 0}, {0, 1}})), 2.0);
    ASSERT_EQ(triangle.mesh.size(), 1u);
    EXPECT_TRUE(triangle.mesh.patches[0].is_triangle());
}

TEST(MakePatches, CutsSliversAcrossToEightWidths) {
    const CutScene strip = cut(scene_of(flat({{0, 0}, {1, 0}, {1, 0.01}, {0, 0.01}})), 1.0);
    EXPECT_EQ(strip.mesh.size(), 13u);  // ⌈1 / 0.08⌉
    EXPECT_LT(worst_aspect(strip), 8.0);
}

TEST(MakePatches, CutsANeedleIntoNoMoreThan256) {
    EXPECT_EQ(cut(scene_of(flat({{0, 0}, {1, 0}, {1, 1e-4}, {0, 1e-4}})), 1.0).mesh.size(), 256u);
}

TEST(MakePatches, FillsNeedlesHoweverSharp) {
    const double along_a_needle = 1e-6;  // coordinates of odd needles are rounded, too
    for (const double width : {1e-3, 1e-4, 3e-5, 1e-5, 1e-6, 1e-7, 1e-8})
        for (const Polygon& needle :
             {flat({{0, 0}, {1, 0}, {1, width}}), flat({{0, 0}, {1, 0}, {0.5, width}}),
              moved(flat({{0, 0}, {1, 0}, {1, width}, {0.1, 0.9 * width}, {0, 0.5 * width}}),
                    {1.0, Vec3::Zero(), odd_turn()})}) {
            const CutScene cut_needle = cut(scene_of(needle), 0.34);
            EXPECT_LT(area_error(cut_needle), along_a_needle) << width;
            EXPECT_LE(cut_needle.mesh.size(), 1280u) << width;
            for (const Patch& patch : cut_needle.mesh.patches) EXPECT_GT(patch.area, 0.0) << width;
        }
}

TEST(MakePatches, ACrumbIsAPatchByItsOwnMeasure) {
    const Polygon crumb = flat({{0, 0}, {1e-10, 0}, {0, 1e-10}});
    const CutScene both = cut(scene_of({flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), crumb}), 9.0);
    const Patch& last = both.mesh.patches.back();
    EXPECT_GT(last.area, 0.0);
    EXPECT_FALSE(both.mesh.patches.front().covered);
}

TEST(MakePatches, KeepsPatchesOfFairShapesFair) {
    const double fair = 10.0;  // of a triangle a fifth as high as long; a square has 1
    for (const Polygon& polygon : {l_shape(), regular(64, 1.0), regular(6, 1.0), comb(3)})
        EXPECT_LT(worst_aspect(cut(scene_of(polygon), 0.15)), fair);
}

TEST(MakePatches, MakesAboutTwoThousandPatchesByDefault) {
    for (const double scale : {1e-3, 1.0, 1e4}) {
        const Scene scene = moved(room_with_box(), {scale});
        const double count =
            static_cast<double>(cut(scene, patch_size_for(scene, 2000.0)).mesh.size());
        EXPECT_NEAR(count, 2000.0, 0.25 * 2000.0) << scale;  // whole cells, and creases
    }
}

TEST(EstimatePatchCount, IsWithinAFactorOfTwo) {
    const std::vector<Scene> scenes{room(),
                                    room_with_box(),
                                    scene_of(regular(24, 1.0)),
                                    scene_of(l_shape()),
                                    scene_of(star(5, 0.4)),
                                    scene_of(comb(3)),
                                    scene_of(regular(3, 1.0)),
                                    scene_of(regular(4, 1.0)),
                                    scene_of(regular(1000, 1.0)),
                                    scene_of(flat({{0, 0}, {1, 0}, {1, 1e-2}, {0, 1e-2}})),
                                    scene_of(flat({{0, 0}, {1, 0}, {1, 1e-5}})),
                                    scene_of(flat({{0, 0}, {1, 0}, {0.5, 1e-3}}))};
    for (std::size_t k = 0; k < scenes.size(); ++k)
        for (const double size : {0.3, 0.1, 0.04}) {
            const double real = static_cast<double>(cut(scenes[k], size).mesh.size());
            const double estimate = static_cast<double>(estimate_patch_count(scenes[k], size));
            EXPECT_LT(estimate, 2.0 * real) << "scene " << k << " at " << size;
            EXPECT_GT(estimate, 0.5 * real) << "scene " << k << " at " << size;
        }
}

TEST(EstimatePatchCount, DoesNotOverflow) {
    EXPECT_GT(estimate_patch_count(room(), 1e-12), std::size_t{1} << 62);
}

TEST(PatchCorners, AreThreeOfATriangleAndFourOfAQuad) {
    const CutScene two = cut(
        scene_of({flat({{0, 0}, {1, 0}, {0, 1}}), flat({{5, 0}, {6, 0}, {6, 1}, {5, 1}})}), 9.0);
    EXPECT_EQ(patch_corners(two.mesh, 0), flat({{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_EQ(patch_corners(two.mesh, 1), flat({{5, 0}, {6, 0}, {6, 1}, {5, 1}}));
}

}  // namespace
}  // namespace patchlight::make_patches_test
