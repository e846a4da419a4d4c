#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>

namespace patchlight::floating_object_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
constexpr double box_reach = 1.0;  // the place may be any corner of what floats [m]

Scene room_with_box_at(double height) {
    Scene scene = lit_room();
    add_body(scene, "box", Vec3(1.0, 1.0, height), Vec3(1.6, 1.7, height + 0.5));
    return scene;
}

TEST(FloatingObject, IsToldOfABoxJustAboveTheFloor) {
    for (const double height : {1e-4, 2e-3})
        expect_told(room_with_box_at(height), "floating-object", {"box", "floor"},
                    Vec3(1.3, 1.35, height), box_reach);
    EXPECT_NE(told(room_with_box_at(2e-3))[0].detail.find("0.002 m"), std::string::npos);
}

TEST(FloatingObject, IsNoneThatStandsOrHangsWellAbove) {
    expect_nothing_told(room_with_box_at(0.0));
    expect_nothing_told(room_with_box_at(1e-7));
    expect_nothing_told(room_with_box_at(0.05));
    expect_nothing_told(room_with_box_at(-1e-3));  // patches are cut where it passes the floor
}

TEST(FloatingObject, IsToldOfATableWhoseFourLegsTouchIt) {
    Scene scene = lit_room();
    const double off = 2e-3;
    for (const double u : {1.0, 1.9})
        for (const double v : {1.0, 1.9})
            add_body(scene, "leg", Vec3(u, v, off), Vec3(u + 0.1, v + 0.1, 0.7 + off));
    add_body(scene, "top", Vec3(0.95, 0.95, 0.7 + off), Vec3(2.05, 2.05, 0.75 + off));
    expect_told(scene, "floating-object", {"leg", "floor"}, Vec3(1.5, 1.5, off), box_reach);
}

TEST(FloatingObject, IsToldOfABoxWithoutABottom) {
    Scene scene = lit_room();
    add_body(scene, "hood", Vec3(1.0, 1.0, 2e-3), Vec3(1.6, 1.7, 0.5));
    std::erase_if(scene.surfaces, [&](const Surface& s) {
        return scene.objects[s.object].name == "hood" && s.normal.z() < -0.5;
    });
    expect_told(scene, "floating-object", {"hood", "floor"}, Vec3(1.3, 1.35, 0.0), box_reach);
}

TEST(FloatingObject, IsNoneThatIsASheetOnAWallOrFloor) {
    Scene scene = lit_room();
    add_named(scene, "poster", rectangle(Vec3(1.0, 2.998, 1.0), 0.6 * x, 0.8 * z));
    add_named(scene, "rug", rectangle(Vec3(1.0, 1.0, 8e-3), 2.0 * x, 1.0 * y));
    add_body(scene, "box", Vec3(1.2, 1.2, 8e-3), Vec3(1.6, 1.6, 0.5));  // stands on the rug
    expect_nothing_told(scene);
}

}  // namespace
}  // namespace patchlight::floating_object_test
