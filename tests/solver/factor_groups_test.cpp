#include "solver/factor_groups.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace patchlight::factor_groups_test {
namespace {

constexpr double rounding = 1e-12;

/// An object of several faces, numbered from `first`.
ObjectIndex add_faces(Scene& scene, const std::string& name, std::uint32_t first,
                      const std::vector<Polygon>& faces, MaterialIndex material = white) {
    const auto object = static_cast<ObjectIndex>(scene.objects.size());
    scene.objects.push_back({name});
    for (const Polygon& face : faces) add_polygon(scene, object, material, first++, face, "/faces");
    return object;
}

Polygon square(double z, double edge = 1.0) {
    return rectangle(Vec3(0, 0, z), edge * Vec3::UnitX(), edge * Vec3::UnitY());
}

FactorGroups groups_of(const Scene& scene, Grouping grouping, double patch_size = 0.5) {
    return make_factor_groups(scene, cut(scene, patch_size).mesh, grouping);
}

/// Each patch belongs to one group, and groups list theirs ascending.
void expect_partition(const FactorGroups& groups, std::size_t patches) {
    ASSERT_EQ(groups.of_patch.size(), patches);
    ASSERT_EQ(groups.patches.size(), groups.areas.size());
    std::size_t listed = 0;
    for (std::uint32_t g = 0; g < groups.patches.size(); ++g) {
        EXPECT_TRUE(std::is_sorted(groups.patches[g].begin(), groups.patches[g].end()));
        for (const PatchIndex i : groups.patches[g]) EXPECT_EQ(groups.of_patch.at(i), g);
        listed += groups.patches[g].size();
    }
    EXPECT_EQ(listed, patches);
}

Scene table_and_floor() {
    Scene scene = empty_scene();
    add_faces(scene, "floor", 0, {square(0.0, 2.0)});
    add_faces(scene, "table", 0, {square(1.0), square(0.9), square(0.8)});
    return scene;
}

TEST(FactorGroups, OfObjectsAreNamedAsTheyAre) {
    const FactorGroups groups = groups_of(table_and_floor(), Grouping::object);
    EXPECT_EQ(groups.names, (std::vector<std::string>{"floor", "table"}));
    EXPECT_NEAR(groups.areas[0], 4.0, rounding);
    EXPECT_NEAR(groups.areas[1], 3.0, rounding);
    expect_partition(groups, 16 + 3 * 4);
}

TEST(FactorGroups, OfFacesAreNumberedWhereAnObjectHasSeveral) {
    const FactorGroups groups = groups_of(table_and_floor(), Grouping::face);
    EXPECT_EQ(groups.names,
              (std::vector<std::string>{"floor", "table[0]", "table[1]", "table[2]"}));
    for (std::size_t k = 1; k < 4; ++k) EXPECT_NEAR(groups.areas[k], 1.0, rounding);
    expect_partition(groups, 16 + 3 * 4);
}

TEST(FactorGroups, OfFacesKeepTheNumberThatWasGivenWhenOthersWereDropped) {
    Scene scene = empty_scene();
    add_faces(scene, "lonely", 0, {{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}, square(0.0)});
    EXPECT_EQ(groups_of(scene, Grouping::face).names, std::vector<std::string>{"lonely[1]"});
}

TEST(FactorGroups, ATwistedFaceIsOneThoughItIsCutIntoTriangles) {
    Scene scene = empty_scene();
    Polygon twisted = square(0.0);
    twisted[2].z() = 0.1;
    add_faces(scene, "sail", 0, {twisted});
    ASSERT_EQ(scene.surfaces.size(), 2u);
    const FactorGroups groups = groups_of(scene, Grouping::face);
    EXPECT_EQ(groups.names, std::vector<std::string>{"sail"});
    EXPECT_NEAR(groups.areas[0], scene.surfaces[0].area + scene.surfaces[1].area, rounding);
}

TEST(FactorGroups, BothSidesOfATwoSidedFaceAreOneWithBothAreas) {
    Scene scene = empty_scene();
    add_faces(scene, "screen", 0, {square(0.0), square(1.0)}, two_sided);
    const FactorGroups faces = groups_of(scene, Grouping::face);
    EXPECT_EQ(faces.names, (std::vector<std::string>{"screen[0]", "screen[1]"}));
    EXPECT_NEAR(faces.areas[0], 2.0, rounding);
    const FactorGroups objects = groups_of(scene, Grouping::object);
    EXPECT_NEAR(objects.areas.at(0), 4.0, rounding);
}

TEST(FactorGroups, AnObjectOfNothingIsThereWithoutPatches) {
    Scene scene = table_and_floor();
    scene.objects.push_back({"empty"});
    const FactorGroups groups = groups_of(scene, Grouping::object);
    EXPECT_EQ(groups.names.back(), "empty");
    EXPECT_EQ(groups.areas.back(), 0.0);
    EXPECT_TRUE(groups.patches.back().empty());
}

TEST(FactorGroups, OfPatchesAreThePatchesWithoutNames) {
    const CutScene scene = cut(table_and_floor(), 0.5);
    const FactorGroups groups = make_factor_groups(scene.scene, scene.mesh, Grouping::patch);
    EXPECT_TRUE(groups.names.empty());
    ASSERT_EQ(groups.areas.size(), scene.mesh.size());
    for (PatchIndex i = 0; i < scene.mesh.size(); ++i) {
        EXPECT_EQ(groups.patches[i], std::vector<PatchIndex>{i});
        EXPECT_EQ(groups.areas[i], scene.mesh.patches[i].area);
    }
    expect_partition(groups, scene.mesh.size());
}

}  // namespace
}  // namespace patchlight::factor_groups_test
