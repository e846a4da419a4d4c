#include "solver/display/vertex_radiosity.h"

#include "solver/scene/polygon.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace patchlight::vertex_radiosity_test {
namespace {

constexpr double rounding = 1e-9;  // of least squares over some eight neighbours

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY();

using Light = std::function<Rgb(const Vec3&)>;

Rgb linear(const Vec3& p) {
    return Rgb(5.0 + p.x() - 2.0 * p.y(), 7.0 + 2.0 * p.x() + p.y() + p.z(), 3.0 - p.x());
}

std::vector<Rgb> at_centres(const PatchMesh& mesh, const Light& light) {
    std::vector<Rgb> radiosity;
    for (const Patch& patch : mesh.patches) radiosity.push_back(light(patch.centre));
    return radiosity;
}

DisplayMesh show(const CutScene& cut, const std::vector<Rgb>& radiosity) {
    return make_display(cut.scene, cut.mesh, radiosity, std::vector<double>(cut.mesh.size(), 0.0));
}

double worst_misfit(const CutScene& cut) {
    const DisplayMesh display = show(cut, at_centres(cut.mesh, linear));
    double worst = 0.0;
    for (std::size_t v = 0; v < display.positions.size(); ++v)
        worst =
            std::max(worst, (display.radiosity[v] - linear(display.positions[v])).abs().maxCoeff());
    return worst;
}

TEST(MakeDisplay, MeetsALinearFieldUpToTheEdgesOfAGrid) {
    EXPECT_LT(worst_misfit(cut(scene_of(rectangle(Vec3::Zero(), x, y)), 0.2)), rounding);
}

TEST(MakeDisplay, MeetsALinearFieldOnATurnedGrid) {
    const Motion motion{1.0, Vec3(0.1, 0.2, 0.3), odd_turn()};
    EXPECT_LT(worst_misfit(cut(scene_of(moved(rectangle(Vec3::Zero(), x, 0.5 * y), motion)), 0.2)),
              rounding);
}

TEST(MakeDisplay, MeetsALinearFieldUpToTheEdgesOfAnyPolygon) {
    for (const Polygon& polygon : {l_shape(), regular(12, 1.0), flat({{0, 0}, {1, 0}, {0.3, 0.9}})})
        EXPECT_LT(worst_misfit(cut(scene_of(polygon), 0.2)), rounding);
}

TEST(MakeDisplay, MeetsALinearFieldInsideAGrid) {
    const CutScene plate = cut(scene_of(rectangle(Vec3::Zero(), x, y)), 0.1);
    const DisplayMesh display = show(plate, at_centres(plate.mesh, linear));
    for (std::size_t v = 0; v < display.positions.size(); ++v) {
        const Vec3& p = display.positions[v];
        if (std::min(p.x(), p.y()) < 0.05 || std::max(p.x(), p.y()) > 0.95) continue;
        EXPECT_LT((display.radiosity[v] - linear(p)).abs().maxCoeff(), rounding) << p.transpose();
    }
}

TEST(MakeDisplay, AConstantIsThatConstant) {
    const Rgb grey(0.3, 0.4, 0.5);
    const CutScene plate = cut(scene_of(star(5, 0.4)), 0.2);
    for (const Rgb& shown : show(plate, std::vector<Rgb>(plate.mesh.size(), grey)).radiosity)
        EXPECT_LT((shown - grey).abs().maxCoeff(), 1e-14);
}

TEST(MakeDisplay, AveragesNothingOverTheCreasesOfARoom) {
    const CutScene cut_room = cut(room_with_box(), 0.2);
    std::vector<Rgb> radiosity;
    for (const Patch& patch : cut_room.mesh.patches)
        radiosity.push_back(Rgb::Constant(1.0 + patch.surface));
    const DisplayMesh display = show(cut_room, radiosity);
    for (std::size_t t = 0; t < display.triangles.size(); ++t)
        for (const std::uint32_t v : display.triangles[t])
            EXPECT_NEAR(display.radiosity[v][0],
                        1.0 + cut_room.mesh.patches[display.patch[t]].surface, 1e-12);
}

TEST(MakeDisplay, AveragesNothingAcrossAPartition) {
    Scene scene = scene_of(rectangle(Vec3::Zero(), x, y));
    add(scene, rectangle(Vec3(0.5, 0, 0), y, Vec3::UnitZ()), two_sided);
    const CutScene split = cut(scene, 0.2);
    const DisplayMesh display = show(
        split, at_centres(split.mesh, [](const Vec3& p) { return Rgb::Constant(p.x() < 0.5); }));
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const Patch& patch = split.mesh.patches[display.patch[t]];
        if (patch.surface != 0) continue;
        for (const std::uint32_t v : display.triangles[t])
            EXPECT_EQ(display.radiosity[v][0], patch.centre.x() < 0.5 ? 1.0 : 0.0);
    }
}

TEST(MakeDisplay, CoversThePolygonWithTrianglesOfThePatches) {
    const CutScene plate = cut(scene_of(l_shape()), 0.3);
    const DisplayMesh display = show(plate, std::vector<Rgb>(plate.mesh.size(), Rgb::Ones()));
    std::vector<double> area(plate.mesh.size(), 0.0);
    for (std::size_t t = 0; t < display.triangles.size(); ++t) {
        const auto& [a, b, c] = display.triangles[t];
        const Polygon triangle{display.positions[a], display.positions[b], display.positions[c]};
        EXPECT_GT(vector_area(triangle).z(), 0.0);  // counter-clockwise from the front
        area[display.patch[t]] += vector_area(triangle).z();
    }
    for (PatchIndex i = 0; i < plate.mesh.size(); ++i)
        EXPECT_NEAR(area[i], plate.mesh.patches[i].area, 1e-14);
}

TEST(MakeDisplay, LeavesOutCoveredPatches) {
    const CutScene floor = cut(
        scene_of({rectangle(Vec3::Zero(), x, y), rectangle(Vec3(0.25, 0.25, 0), 0.5 * x, 0.5 * y)}),
        0.25);
    std::vector<Rgb> radiosity;
    for (const Patch& patch : floor.mesh.patches)
        radiosity.push_back(Rgb::Constant(patch.covered ? 0.0 : 1.0));
    const DisplayMesh display = show(floor, radiosity);
    for (const PatchIndex i : display.patch) EXPECT_FALSE(floor.mesh.patches[i].covered);
    for (const Rgb& shown : display.radiosity) EXPECT_EQ(shown[0], 1.0);
}

TEST(MakeDisplay, StaysWithinItsLimits) {
    const CutScene plate = cut(scene_of(l_shape()), 0.2);
    std::mt19937 chance(1);
    std::vector<Rgb> radiosity;
    double lowest = 1e300, highest = 0.0;
    for (PatchIndex i = 0; i < plate.mesh.size(); ++i) {
        const double b = uniform(chance) < 0.5 ? 0.0 : 10.0 * uniform(chance);
        lowest = std::min(lowest, b), highest = std::max(highest, b);
        radiosity.push_back(Rgb(b, 5.0 + b, 0.0));
    }
    for (const Rgb& shown : show(plate, radiosity).radiosity) {
        EXPECT_GE(shown[0], 0.0);
        EXPECT_LE(shown[0], highest + (highest - lowest));  // the slope over one more patch at most
        EXPECT_EQ(shown[2], 0.0);
    }
}

TEST(MakeDisplay, AStepAcrossAShadowsEdgeStaysBetweenLightAndShade) {
    const CutScene plate = cut(scene_of(rectangle(Vec3::Zero(), x, y)), 0.1);
    const DisplayMesh display = show(
        plate, at_centres(plate.mesh, [](const Vec3& p) { return Rgb::Constant(p.x() > 0.5); }));
    for (const Rgb& shown : display.radiosity) {
        EXPECT_GE(shown[0], 0.0);
        EXPECT_LE(shown[0], 1.25);  // no more than a quarter of the step beyond it
    }
}

TEST(MakeDisplay, APatchThatSeesNothingButBacksDarkensNoNeighbour) {
    const CutScene plate = cut(scene_of(rectangle(Vec3::Zero(), x, y)), 0.25);
    std::vector<Rgb> radiosity(16, Rgb::Ones());
    std::vector<double> hidden(16, 0.0);
    radiosity[5] = Rgb::Zero();
    hidden[5] = 1.0;
    for (const Rgb& shown : make_display(plate.scene, plate.mesh, radiosity, hidden).radiosity)
        EXPECT_EQ(shown[0], 1.0);
}

TEST(MakeDisplay, WhatIsAllHiddenIsAsDarkAsItIs) {
    const CutScene plate = cut(scene_of(rectangle(Vec3::Zero(), x, y)), 0.5);
    const std::vector<Rgb> dark(4, Rgb::Zero());
    for (const Rgb& shown :
         make_display(plate.scene, plate.mesh, dark, std::vector<double>(4, 1.0)).radiosity)
        EXPECT_EQ(shown[0], 0.0);
}

}  // namespace
}  // namespace patchlight::vertex_radiosity_test
