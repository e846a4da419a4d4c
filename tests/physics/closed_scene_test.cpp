#include "tests/physics/rooms.h"

#include <cmath>

namespace patchlight::closed_scene_test {

namespace {

constexpr double identity = 1e-4;  // relative, exact for exact factors (s-d02)

/// Light that is absorbed is the light that is emitted, whatever the reflectances.
void expect_balance(const Scene& scene, const Way& way) {
    SolveSettings settings = settings_of(way);
    settings.patch_size = 0.15;
    set_rays(settings, 1024);
    const Solution solution = solve(scene, settings);
    EXPECT_LT(solution.energy.defect, identity);
    const double emitted = solution.energy.emitted[0];
    const double backs = solution.energy.backs[0] + solution.energy.escaped[0];
    EXPECT_NEAR(solution.energy.absorbed[0] + backs, emitted, identity * emitted);
    EXPECT_EQ(solution.energy.escaped[0], 0.0);
}

}  // namespace

class ClosedScene : public EveryEngineAndMethod {};

TEST_P(ClosedScene, ConvexRoomKeepsItsEnergy) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.6, 0.0), {0, 0, 0}, {1, 1.4, 0.8}, true);
    builder.polygon("lamp", builder.material(0.2, 5.0),
                    {{0.4, 0.5, 0.8}, {0.4, 0.8, 0.8}, {0.7, 0.8, 0.8}, {0.7, 0.5, 0.8}});
    expect_balance(builder.scene, GetParam());
}

TEST_P(ClosedScene, RoomWithObstaclesKeepsItsEnergyAfterRepair) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.7, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    builder.box("stand", builder.material(0.3, 0.0), {0.2, 0.2, 0}, {0.5, 0.4, 0.6}, false);
    builder.box("float", builder.material(0.5, 0.0), {0.6, 0.5, 0.3}, {0.8, 0.9, 0.5}, false);
    builder.polygon("lamp", builder.material(0.2, 5.0),
                    {{0.4, 0.4, 1}, {0.4, 0.6, 1}, {0.6, 0.6, 1}, {0.6, 0.4, 1}});
    expect_balance(builder.scene, GetParam());
}

TEST_P(ClosedScene, UniformReflectanceGivesTheKnownMeans) {
    SceneBuilder builder;
    const double rho = 0.6;
    builder.box("room", builder.material(rho, 0.0), {0, 0, 0}, {1, 1, 1}, true);
    builder.box("float", builder.material(rho, 3.0), {0.3, 0.35, 0.4}, {0.7, 0.6, 0.55}, false);
    SolveSettings settings = settings_of(GetParam());
    settings.patch_size = 0.125;
    set_rays(settings, 1024);
    const Solution solution = solve(builder.scene, settings);
    double area = 0.0, radiosity = 0.0, irradiance = 0.0, exitance = 0.0;
    for (const ObjectReport& object : solution.objects) {
        area += object.area;
        radiosity += object.area * object.radiosity[0];
        irradiance += object.area * object.irradiance[0];
        exitance += object.emitted[0];
    }
    const double exact = exitance / area / (1.0 - rho);
    EXPECT_NEAR(radiosity / area, exact, identity * exact);
    EXPECT_NEAR(irradiance / area, exact, identity * exact);
}

TEST_P(ClosedScene, NoLightCrossesASharedWall) {
    for (const double thickness : {0.0, 1e-6, 1e-3, 0.05}) {
        SceneBuilder builder;
        builder.box("lit", builder.material(0.8, 1.0), {0, 0, 0}, {1, 1, 1}, true);
        builder.box("dark", builder.material(0.8, 0.0), {1 + thickness, 0, 0},
                    {2 + thickness, 1, 1}, true);
        builder.sensor({1.5, 0.5, 0.5}, -Vec3::UnitX());
        SolveSettings settings = settings_of(GetParam());
        settings.patch_size = 0.2;
        set_rays(settings, 1024);
        const Solution solution = solve(builder.scene, settings);
        for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
            if (scene_object(builder.scene, solution, i) != 1) continue;
            ASSERT_EQ(solution.radiosity[i][0], 0.0) << thickness;
        }
        EXPECT_EQ(solution.sensors[0].irradiance[0], 0.0);
        for (const std::uint32_t v : object_vertices(builder.scene, solution, 1))
            ASSERT_EQ(solution.display.radiosity[v][0], 0.0);
    }
}

TEST_P(ClosedScene, NoLightCrossesAWallUnderOneCommonFloor) {
    SceneBuilder
        builder;  // floor, ceiling and long walls run through; a two-sided wall parts the rooms
    const MaterialIndex wall = builder.material(0.8, 0.0);
    builder.box("shell", wall, {0, 0, 0}, {2, 1, 1}, true);
    const MaterialIndex parting = builder.material(0.8, 0.0);
    builder.scene.materials[parting].two_sided = true;
    builder.polygon("wall", parting, {{0.97, 0, 0}, {0.97, 1, 0}, {0.97, 1, 1}, {0.97, 0, 1}});
    builder.polygon("lamp", builder.material(0.0, 10.0),
                    {{0.3, 0.3, 1}, {0.3, 0.7, 1}, {0.6, 0.7, 1}, {0.6, 0.3, 1}});
    SolveSettings settings = settings_of(GetParam());
    settings.patch_size = 0.125;
    set_rays(settings, 1024);
    const Solution solution = solve(builder.scene, settings);
    double lit = 0.0;
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        if (solution.mesh.patches[i].centre.x() > 0.97 + 1e-9)
            ASSERT_EQ(solution.radiosity[i][0], 0.0) << solution.mesh.patches[i].centre.transpose();
        else
            lit += solution.radiosity[i][0];
    }
    EXPECT_GT(lit, 0.0);
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t) {
        if (solution.mesh.patches[solution.display.patch[t]].centre.x() <= 0.97 + 1e-9) continue;
        for (const std::uint32_t v : solution.display.triangles[t])
            ASSERT_EQ(solution.display.radiosity[v][0], 0.0) << "drawn across the foot of the wall";
    }
}

TEST_P(ClosedScene, AnyNumberOfThreadsGivesTheSameBytes) {
    SceneBuilder builder;
    builder.box("room", builder.material(0.7, 0.1), {0, 0, 0}, {1, 1, 1}, true);
    builder.box("float", builder.material(0.3, 0.0), {0.2, 0.2, 0.3}, {0.5, 0.4, 0.6}, false);
    builder.sensor({0.1, 0.2, 0.1}, Vec3::UnitZ());
    SolveSettings settings = settings_of(GetParam());
    settings.patch_size = 0.15;
    set_rays(settings, 512);
    settings.threads = 1;
    const Solution one = solve(builder.scene, settings);
    settings.threads = 2;
    const Solution two = solve(builder.scene, settings);
    ASSERT_EQ(one.mesh.size(), two.mesh.size());
    for (PatchIndex i = 0; i < one.mesh.size(); ++i)
        ASSERT_TRUE((one.radiosity[i] == two.radiosity[i]).all());
    EXPECT_TRUE((one.sensors[0].irradiance == two.sensors[0].irradiance).all());
}

INSTANTIATE_TEST_SUITE_P(EveryWay, ClosedScene, testing::ValuesIn(every_way()), way_name);

}  // namespace patchlight::closed_scene_test
