#include "tests/solver/findings/flawed_room.h"

#include "solver/solve_scene.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace patchlight {

namespace {

constexpr double width = 4.0, depth = 3.0, height = 2.5;  // [m]
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

}  // namespace

void add_named(Scene& scene, const std::string& name, const Polygon& polygon,
               MaterialIndex material) {
    add(scene, polygon, material);
    scene.objects.back().name = name;
}

void add_body(Scene& scene, const std::string& name, const Vec3& low, const Vec3& high,
              Facing facing, MaterialIndex material) {
    const auto first = scene.objects.size();
    const auto first_surface = scene.surfaces.size();
    add_box(scene, low, high, facing);
    for (std::size_t s = first_surface; s < scene.surfaces.size(); ++s) {
        scene.surfaces[s].object = static_cast<ObjectIndex>(first);
        scene.surfaces[s].material = material;
    }
    scene.objects.resize(first + 1);
    scene.objects.back().name = name;
}

Scene lit_room(const std::string& without) {
    Scene scene = empty_scene();
    const auto wall = [&](const std::string& name, const Polygon& polygon) {
        if (name != without) add_named(scene, name, polygon);
    };
    wall("floor", rectangle(Vec3::Zero(), width * x, depth * y));
    wall("ceiling", rectangle(height * z, depth * y, width * x));
    wall("west", rectangle(Vec3::Zero(), depth * y, height * z));
    wall("east", rectangle(width * x, height * z, depth * y));
    wall("south", rectangle(Vec3::Zero(), height * z, width * x));
    wall("north", rectangle(depth * y, width * x, height * z));
    if (without != "lamp")
        add_named(scene, "lamp", rectangle(Vec3(1.8, 1.3, 2.4), 0.5 * y, 0.5 * x), lamp);
    return scene;
}

std::vector<Finding> told(const Scene& scene, const SolveSettings& settings) {
    return find_flaws(scene, settings);
}

std::string kinds(const std::vector<Finding>& findings) {
    std::string list;
    for (const Finding& finding : findings) list += finding.kind + " ";
    return list;
}

Vec3 place_of(const Finding& finding) {
    Vec3 place = Vec3::Constant(1e300);
    for (std::size_t open = finding.detail.find('('); open != std::string::npos;
         open = finding.detail.find('(', open + 1))
        if (std::sscanf(finding.detail.c_str() + open, "(%lf, %lf, %lf) m", &place[0], &place[1],
                        &place[2]) == 3)
            break;
    return place;
}

void expect_told(const Scene& scene, const std::string& kind,
                 const std::vector<std::string>& objects, const Vec3& place, double reach,
                 const SolveSettings& settings) {
    const std::vector<Finding> findings = told(scene, settings);
    ASSERT_EQ(kinds(findings), kind + " ");
    EXPECT_EQ(findings[0].objects, objects) << findings[0].detail;
    EXPECT_LE((place_of(findings[0]) - place).norm(), reach) << findings[0].detail;
    EXPECT_FALSE(findings[0].remedy.empty());
}

void expect_nothing_told(const Scene& scene, const SolveSettings& settings) {
    const std::vector<Finding> findings = told(scene, settings);
    EXPECT_EQ(kinds(findings), "") << findings[0].detail;
}

}  // namespace patchlight
