#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>

namespace patchlight::light_balance_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// The room with a hole in the corner of its north wall.
Scene room_with_hole(double width, double height) {
    Scene scene = lit_room("north");
    add_named(scene, "north",
              {Vec3(0, 3, 0), Vec3(4 - width, 3, 0), Vec3(4 - width, 3, height), Vec3(4, 3, height),
               Vec3(4, 3, 2.5), Vec3(0, 3, 2.5)});
    return scene;
}

TEST(OpenEnclosure, IsToldOfARoomWithAHole) {
    const std::vector<Finding> findings = told(room_with_hole(0.8, 1.0));
    ASSERT_EQ(kinds(findings), "open-enclosure ");
    EXPECT_EQ(findings[0].objects[0], "north");
    const double within_the_hole = 0.4;
    EXPECT_LE((place_of(findings[0]) - Vec3(3.6, 3.0, 0.5)).norm(), within_the_hole)
        << findings[0].detail;
    EXPECT_FALSE(findings[0].remedy.empty());
}

TEST(OpenEnclosure, IsNoneThatIsClosedOrOpenOnPurpose) {
    expect_nothing_told(lit_room());
    for (const char* wall : {"south", "ceiling", "floor"}) expect_nothing_told(lit_room(wall));
}

Scene white_room(double reflectance, const std::string& without = "") {
    Scene scene = lit_room(without);
    scene.materials[white].reflectance = Rgb(0.5, reflectance, 0.2);
    scene.materials[lamp].reflectance = Rgb::Constant(0.9);
    return scene;
}

TEST(NearSingular, IsToldOfAClosedRoomThatLosesNoLight) {
    const std::vector<Finding> findings = told(white_room(0.999));
    ASSERT_EQ(kinds(findings), "near-singular ");
    EXPECT_EQ(findings[0].objects.size(), 6u);  // the walls
    EXPECT_LE((place_of(findings[0]) - Vec3(2.0, 1.5, 1.25)).norm(), 2.0);
    EXPECT_NE(findings[0].detail.find("times"), std::string::npos) << findings[0].detail;
    EXPECT_FALSE(findings[0].remedy.empty());
}

TEST(NearSingular, IsNoneThatIsOpenOrReflectsLess) {
    expect_nothing_told(white_room(0.95));
    expect_nothing_told(white_room(0.999, "south"));
}

SolveSettings counted(Engine engine, int samples) {
    SolveSettings settings;
    settings.engine = engine;
    settings.patch_size = 0.2;
    if (engine == Engine::hemicube)
        settings.hemicube_resolution = samples;
    else
        settings.rays = samples;
    return settings;
}

Scene room_with_lamp(double edge) {
    Scene scene = lit_room("lamp");
    add_named(scene, "bulb", rectangle(Vec3(2.0, 1.5, 2.3), edge * y, edge * x), lamp);
    return scene;
}

TEST(SmallEmitter, IsToldWhereTooFewSamplesMeetIt) {
    for (const auto& [engine, samples] : {std::pair(Engine::ray_cast, 512), {Engine::hemicube, 24}})
        expect_told(room_with_lamp(0.01), "small-emitter", {"bulb"}, Vec3(2.0, 1.5, 2.3), 0.02,
                    counted(engine, samples));
}

TEST(SmallEmitter, IsNoneForMoreSamplesLargerLampsAndBetterWays) {
    expect_nothing_told(room_with_lamp(0.01), counted(Engine::ray_cast, 65536));
    expect_nothing_told(room_with_lamp(0.01), counted(Engine::hemicube, 512));
    expect_nothing_told(room_with_lamp(0.6), counted(Engine::ray_cast, 512));
    expect_nothing_told(room_with_lamp(0.01), counted(Engine::analytic, 512));
    expect_nothing_told(room_with_lamp(0.01));
}

}  // namespace
}  // namespace patchlight::light_balance_test
