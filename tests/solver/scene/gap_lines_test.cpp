#include "solver/scene/gap_lines.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace patchlight::gap_lines_test {
namespace {

constexpr double rounding = 1e-9;  // of coordinates of order 10 [m]
constexpr double reflective = 0.9;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// The unit cube with a square of 0.3 m so far below its ceiling, surface 6, facing it.
Scene lamp_below_ceiling(double gap, double reflectance = reflective) {
    Scene scene = room();
    add(scene, rectangle(Vec3(0.2, 0.4, 1.0 - gap), 0.3 * x, 0.3 * y));
    for (Material& material : scene.materials) material.reflectance = Rgb::Constant(reflectance);
    return scene;
}

constexpr SurfaceIndex ceiling = 1;

double total_length(const std::vector<GapLine>& lines) {
    double sum = 0.0;
    for (const GapLine& line : lines) sum += (line.at[1] - line.at[0]).norm();
    return sum;
}

TEST(GapLines, ALampCloseBelowTheCeilingIsOutlinedOnIt) {
    const auto lines = find_gap_lines(lamp_below_ceiling(0.03));
    ASSERT_EQ(lines[ceiling].size(), 4u);
    EXPECT_NEAR(total_length(lines[ceiling]), 1.2, rounding);
    for (const GapLine& line : lines[ceiling]) {
        EXPECT_NEAR(line.height, 0.03, rounding);
        for (const Vec3& end : line.at) {
            EXPECT_NEAR(end.z(), 1.0, rounding);
            EXPECT_NEAR(std::abs(end.x() - 0.35), 0.15, rounding);
            EXPECT_NEAR(std::abs(end.y() - 0.55), 0.15, rounding);
        }
    }
    for (SurfaceIndex s = 0; s < lines.size(); ++s) EXPECT_EQ(lines[s].empty(), s != ceiling) << s;
}

TEST(GapLines, TurnWithTheScene) {
    const Motion motion{7.0, Vec3(-3, 9, 2), odd_turn()};
    const auto lines = find_gap_lines(moved(lamp_below_ceiling(0.03), motion));
    EXPECT_NEAR(total_length(lines[ceiling]), 8.4, 10 * rounding);
}

TEST(GapLines, NoneWhereLightLeavesTheGapAtOnce) {
    EXPECT_TRUE(find_gap_lines(lamp_below_ceiling(0.3))[ceiling].empty()) << "wide";
    EXPECT_TRUE(find_gap_lines(lamp_below_ceiling(0.03, 0.3))[ceiling].empty()) << "dark";
    Scene away = lamp_below_ceiling(0.03);
    std::reverse(away.surfaces.back().corners.begin(), away.surfaces.back().corners.end());
    away.surfaces.back().normal *= -1.0;
    EXPECT_TRUE(find_gap_lines(away)[ceiling].empty()) << "it shows its back";
    EXPECT_TRUE(find_gap_lines(room())[ceiling].empty());
}

TEST(GapLines, AnEdgeThatTwoTrianglesShareIsNone) {
    Scene scene = room();
    const Vec3 a(0.2, 0.4, 0.97), b(0.5, 0.4, 0.97), c(0.5, 0.7, 0.97), d(0.2, 0.7, 0.97);
    add(scene, {a, b, c});
    add(scene, {a, c, d});
    for (Material& material : scene.materials) material.reflectance = Rgb::Constant(reflective);
    const auto lines = find_gap_lines(scene);
    EXPECT_EQ(lines[ceiling].size(), 4u);
    EXPECT_NEAR(total_length(lines[ceiling]), 1.2, rounding);
}

TEST(GapLines, APatchLiesInTheGapOrBesideIt) {
    const Scene scene = lamp_below_ceiling(0.03);
    MeshLines lines = find_mesh_lines(scene);
    add_gap_lines(scene, lines);
    const PatchMesh mesh = make_patches(scene, lines, 1.0);
    double above = 0.0;
    for (PatchIndex i = mesh.first_of_surface[ceiling]; i < mesh.first_of_surface[ceiling + 1];
         ++i) {
        const Vec3 middle = mesh.patches[i].centre;
        const bool is_in = std::abs(middle.x() - 0.35) < 0.15 && std::abs(middle.y() - 0.55) < 0.15;
        if (is_in) above += mesh.patches[i].area;
    }
    EXPECT_NEAR(above, 0.09, rounding);
}

TEST(GapLines, ALineThatIsNearlyThereAlreadyIsNotAddedAgain) {
    Scene scene = lamp_below_ceiling(0.03);
    // A housing that reaches the ceiling a centimetre about the lamp: its own line is as good.
    add_box(scene, Vec3(0.19, 0.39, 0.9), Vec3(0.51, 0.71, 1.0), Facing::inwards);
    for (Material& material : scene.materials) material.reflectance = Rgb::Constant(reflective);
    MeshLines lines = find_mesh_lines(scene);
    const std::size_t before = lines.creases[ceiling].size();
    ASSERT_GE(before, 4u);
    add_gap_lines(scene, lines);
    EXPECT_EQ(lines.creases[ceiling].size(), before);
}

}  // namespace
}  // namespace patchlight::gap_lines_test
