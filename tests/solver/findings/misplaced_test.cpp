#include "solver/findings/misplaced.h"

#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::misplaced_test {
namespace {

Misplaced search(const Scene& scene, std::span<const Viewpoint> viewpoints = {}) {
    const CoplanarOverlaps overlaps = find_coplanar_overlaps(scene);
    const RayScene rays(scene, overlaps);
    return find_misplaced(FlawSearch{scene, overlaps, rays}, viewpoints);
}

/// The room of 4 x 3 x 2.5 m with a table of 1 x 1 x 0.7 m in it.
Scene furnished_room() {
    Scene scene = lit_room();
    add_body(scene, "table", Vec3(2, 1, 0), Vec3(3, 2, 0.7));
    return scene;
}

bool is_misplaced(Scene scene, const Vec3& position, const Vec3& normal = Vec3::UnitZ()) {
    scene.sensors = {{"s", position, normal}};
    const Misplaced found = search(scene);
    EXPECT_EQ(found.findings.size(), found.sensors.at(0) ? 1u : 0u);
    return found.sensors.at(0);
}

TEST(Misplaced, SensorsInARoomAreNot) {
    const Scene scene = furnished_room();
    for (const Vec3& inside : {Vec3(1, 1, 0.8), Vec3(1, 1, 0), Vec3(1, 1, 1e-4), Vec3(0, 1, 1),
                               Vec3(2.5, 1.5, 0.7), Vec3(2, 1.5, 2.45), Vec3(0.001, 0.001, 0.001)})
        for (const Vec3& normal : {Vec3(Vec3::UnitZ()), Vec3(Vec3::UnitX())})
            EXPECT_FALSE(is_misplaced(scene, inside, normal)) << inside.transpose();
    EXPECT_FALSE(is_misplaced(scene, Vec3(1, 1, 2.5), -Vec3::UnitZ()));
    EXPECT_FALSE(is_misplaced(scene, Vec3(4, 1, 1), -Vec3::UnitX()));
}

TEST(Misplaced, SensorsInFurnitureUnderTheFloorAndBeyondWallsAre) {
    const Scene scene = furnished_room();
    for (const Vec3& outside : {Vec3(2.5, 1.5, 0.3), Vec3(1, 1, -0.1), Vec3(4.3, 1, 0.8),
                                Vec3(-1, -1, 1), Vec3(1, 1, 2.6)})
        for (const Vec3& normal : {Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitZ()), Vec3(Vec3::UnitX())})
            EXPECT_TRUE(is_misplaced(scene, outside, normal)) << outside.transpose();
}

TEST(Misplaced, SensorsInTheOpenAreNot) {
    Scene scene = empty_scene();
    add_named(scene, "ground", rectangle(Vec3::Zero(), 4.0 * Vec3::UnitX(), 4.0 * Vec3::UnitY()));
    EXPECT_FALSE(is_misplaced(scene, Vec3(1, 1, 0)));
    EXPECT_FALSE(is_misplaced(scene, Vec3(1, 1, 2)));
    EXPECT_TRUE(is_misplaced(scene, Vec3(1, 1, -0.5)));
}

TEST(Misplaced, PointsOfAGridAreToldInOneFindingThatCountsThem) {
    Scene scene = furnished_room();
    scene.grids.push_back({"spill", 0, 8, 1});
    for (int k = 0; k < 8; ++k)
        scene.sensors.push_back({"spill[" + std::to_string(k) + ",0]", Vec3(0.25 + k, 1.5, 1.0)});
    scene.sensors.push_back({"desk", Vec3(1, 1, -1)});
    const Misplaced found = search(scene);
    EXPECT_EQ(std::count(found.sensors.begin(), found.sensors.end(), true), 5);
    ASSERT_EQ(kinds(found.findings), "sensor-misplaced ");
    EXPECT_EQ(found.findings[0].count, 5u);
    EXPECT_NE(found.findings[0].detail.find("'spill' (4 of 8 points), 'desk'"), std::string::npos)
        << found.findings[0].detail;
}

TEST(Misplaced, CamerasThatSeeBacksAloneAreToldOf) {
    const Scene scene = furnished_room();
    const std::vector<Viewpoint> viewpoints{{"in", Vec3(1, 1, 1.6)},
                                            {"table", Vec3(2.5, 1.5, 0.3)},
                                            {"cellar", Vec3(1, 1, -2)},
                                            {"yard", Vec3(9, 1, 1)}};
    const Misplaced found = search(scene, viewpoints);
    ASSERT_EQ(kinds(found.findings), "camera-misplaced camera-misplaced camera-misplaced ");
    EXPECT_NE(found.findings[0].detail.find("'table'"), std::string::npos);
    EXPECT_EQ(found.findings[0].objects, std::vector<std::string>{"table"});
    EXPECT_NE(found.findings[1].detail.find("'cellar'"), std::string::npos);
    // A room without its south wall is looked into from there.
    const std::vector<Viewpoint> before{{"front", Vec3(2, -5, 1)}};
    EXPECT_TRUE(search(lit_room("south"), before).findings.empty());
}

}  // namespace
}  // namespace patchlight::misplaced_test
