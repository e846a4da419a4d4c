#include "solver/accuracy/displayed_field.h"

#include "solver/display/vertex_radiosity.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <functional>

namespace patchlight::displayed_field_test {
namespace {

constexpr double rounding = 1e-10;  // of weights that sum to 1, times values of order 10

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

Rgb linear(const Vec3& p) {
    return Rgb(5.0 + p.x() - 2.0 * p.y(), 7.0 + 2.0 * p.x() + p.y() + p.z(), 3.0 - p.x());
}

/// Displays that field at the vertices of a cut scene.
Solution showing(const CutScene& cut, const std::function<Rgb(const Vec3&)>& light) {
    Solution solution;
    solution.mesh = cut.mesh;
    solution.display =
        make_display(cut.scene, cut.mesh, std::vector<Rgb>(cut.mesh.size(), Rgb::Zero()),
                     std::vector<double>(cut.mesh.size(), 0.0));
    for (std::size_t v = 0; v < solution.display.positions.size(); ++v)
        solution.display.radiosity[v] = light(solution.display.positions[v]);
    return solution;
}

double worst_misfit(const Scene& scene) {
    const CutScene cut = patchlight::cut(scene, 0.07);
    const DisplayedField field(cut.scene, showing(cut, linear));
    std::mt19937 chance(5);
    double worst = 0.0;
    for (PatchIndex i = 0; i < cut.mesh.size(); ++i)
        for (int k = 0; k < 8; ++k) {
            const Vec3 point = random_point(cut.mesh, i, chance);
            const Rgb shown = field.radiosity(cut.mesh.patches[i].surface, point);
            worst = std::max(worst, (shown - linear(point)).abs().maxCoeff());
        }
    return worst;
}

TEST(DisplayedField, MeetsALinearFieldAnywhereOnAnyPolygon) {
    for (const Polygon& polygon :
         {rectangle(Vec3::Zero(), x, y), l_shape(), regular(12, 1.0), star(7, 0.4), comb(5)})
        EXPECT_LT(worst_misfit(scene_of(polygon)), rounding);
}

TEST(DisplayedField, MeetsALinearFieldOnATurnedPolygon) {
    const Motion motion{1.0, Vec3(0.1, 0.2, 0.3), odd_turn()};
    EXPECT_LT(worst_misfit(scene_of(moved(l_shape(), motion))), rounding);
}

TEST(DisplayedField, MeetsALinearFieldOnEveryWallOfARoom) {
    EXPECT_LT(worst_misfit(room_with_box()), rounding);
}

TEST(DisplayedField, TakesTheSurfaceThatIsAskedForWhereTwoMeet) {
    const CutScene cut =
        patchlight::cut(scene_of({rectangle(Vec3::Zero(), x, y), rectangle(x, x, y)}), 0.25);
    const auto steps = [](const Vec3& p) { return Rgb(Rgb::Constant(p.x() < 1.0 ? 1.0 : 2.0)); };
    Solution solution = showing(cut, steps);
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t)
        for (const std::uint32_t v : solution.display.triangles[t])
            solution.display.radiosity[v] =
                Rgb::Constant(1.0 + cut.mesh.patches[solution.display.patch[t]].surface);
    // Vertices of smooth surfaces in one plane may be shared: look where they are not.
    const DisplayedField field(cut.scene, solution);
    EXPECT_EQ(field.radiosity(0, Vec3(0.5, 0.4, 0.0))[0], 1.0);
    EXPECT_EQ(field.radiosity(1, Vec3(1.5, 0.4, 0.0))[0], 2.0);
}

TEST(DisplayedField, APointBesideAllTrianglesTakesTheBorder) {
    const CutScene cut = patchlight::cut(scene_of(rectangle(Vec3::Zero(), x, y)), 0.25);
    const DisplayedField field(
        cut.scene, showing(cut, [](const Vec3& p) { return Rgb(Rgb::Constant(p.x())); }));
    EXPECT_NEAR(field.radiosity(0, Vec3(1.0 + 1e-8, 0.3, 0.0))[0], 1.0, rounding);
    EXPECT_NEAR(field.radiosity(0, Vec3(-1e-8, 0.3, 0.0))[0], 0.0, rounding);
    EXPECT_GE(field.radiosity(0, Vec3(7.0, 0.3, 0.0))[0], 0.75);  // far off: the nearest patch's
}

TEST(DisplayedField, OfASurfaceThatIsCoveredNothingIsShown) {
    const Polygon plate = rectangle(Vec3::Zero(), x, y);
    const CutScene cut = patchlight::cut(scene_of({plate, plate}), 0.25);
    const DisplayedField field(cut.scene, showing(cut, linear));
    EXPECT_FALSE(field.shows(0));
    EXPECT_TRUE(field.shows(1));
    EXPECT_TRUE((field.radiosity(0, Vec3(0.5, 0.5, 0.0)) == 0.0).all());
}

}  // namespace
}  // namespace patchlight::displayed_field_test
