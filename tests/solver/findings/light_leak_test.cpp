#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>

namespace patchlight::light_leak_test {
namespace {

using Names = std::vector<std::string>;

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// The room with its north wall off the floor.
Scene room_with_gap(double width) {
    Scene scene = lit_room("north");
    add_named(scene, "north", rectangle(3.0 * y + width * z, 4.0 * x, (2.5 - width) * z));
    return scene;
}

TEST(LightLeak, IsToldWhereAWallEndsAboveTheFloor) {
    for (const double width : {5e-5, 1e-3, 0.02}) {
        const double half_the_wall = 2.1;  // the place may be anywhere along it [m]
        expect_told(room_with_gap(width), "light-leak", {"floor", "north"},
                    Vec3(2.0, 3.0, 0.5 * width), half_the_wall);
        const Finding finding = told(room_with_gap(width))[0];
        EXPECT_NE(finding.detail.find("light gets out"), std::string::npos) << finding.detail;
        EXPECT_LT(std::abs(place_of(finding).y() - 3.0), 0.03) << finding.detail;
    }
}

TEST(LightLeak, IsToldWhereAWallStandsOffAllOthers) {
    for (const double off : {1e-4, 1e-2}) {
        Scene scene = lit_room("east");
        add_named(scene, "east", rectangle((4.0 + off) * x, 2.5 * z, 3.0 * y));
        const std::vector<Finding> findings = told(scene);
        EXPECT_EQ(kinds(findings), "light-leak light-leak light-leak light-leak ");
        for (const Finding& finding : findings) {
            EXPECT_TRUE(finding.objects[0] == "east" || finding.objects[1] == "east");
            EXPECT_NEAR(place_of(finding).x(), 4.0, 1.5 * off) << finding.detail;
        }
    }
}

TEST(LightLeak, IsNoneWithinTheContactDistance) {
    const double touching = 2e-6;  // the room is 5.6 m from corner to corner
    expect_nothing_told(room_with_gap(touching));
}

TEST(LightLeak, IsToldWhateverTheSizeAndPlaceOfTheScene) {
    for (const Motion& motion :
         {Motion{1e-4, Vec3::Zero(), odd_turn()}, Motion{1e5, Vec3::Zero(), odd_turn()},
          Motion{1.0, Vec3(1e4, -1e4, 1e4), odd_turn()}})
        EXPECT_EQ(kinds(told(moved(room_with_gap(2e-3), motion))), "light-leak ");
}

/// Two rooms that share a wall of both sides, `gap` short of the ceiling; only one has a lamp.
Scene two_rooms(double gap) {
    Scene scene = lit_room();
    add_named(scene, "partition", rectangle(Vec3(1.0, 0.0, 0.0), 3.0 * y, (2.5 - gap) * z),
              two_sided);
    return scene;
}

TEST(LightLeak, IsToldBetweenTwoRooms) {
    expect_told(two_rooms(2e-3), "light-leak", {"partition", "ceiling"}, Vec3(1.0, 1.5, 2.499),
                1.0);
    const Finding finding = told(two_rooms(2e-3))[0];
    EXPECT_NE(finding.detail.find("into another room"), std::string::npos) << finding.detail;
}

TEST(LightLeak, IsNoneUnderAScreenThatLeavesTheRoomOne) {
    Scene scene = lit_room();
    add_named(scene, "screen", rectangle(Vec3(1.0, 0.0, 0.01), 1.5 * y, 1.8 * z), two_sided);
    expect_nothing_told(scene);
}

TEST(LightLeak, IsToldBetweenWallsThatAreSolid) {
    Scene scene = empty_scene();
    const double slit = 4e-3;
    add_body(scene, "floor", Vec3(-0.2, -0.2, -0.2), Vec3(4.2, 3.2, 0.0));
    add_body(scene, "ceiling", Vec3(-0.2, -0.2, 2.5), Vec3(4.2, 3.2, 2.7));
    add_body(scene, "west", Vec3(-0.2, -0.2, 0.0), Vec3(0.0, 3.2, 2.5));
    add_body(scene, "east", Vec3(4.0, -0.2, 0.0), Vec3(4.2, 3.2, 2.5));
    add_body(scene, "south", Vec3(0.0, -0.2, 0.0), Vec3(4.0, 0.0, 2.5));
    add_body(scene, "north", Vec3(0.0, 3.0, 0.0), Vec3(4.0, 3.2, 2.5 - slit));
    add_named(scene, "lamp", rectangle(Vec3(1.8, 1.3, 2.4), 0.5 * y, 0.5 * x), lamp);
    const std::vector<Finding> findings = told(scene);
    ASSERT_EQ(kinds(findings), "light-leak ");
    EXPECT_EQ(findings[0].objects, (Names{"ceiling", "north"})) << findings[0].detail;
    EXPECT_NEAR(place_of(findings[0]).z(), 2.5 - 0.5 * slit, slit) << findings[0].detail;
}

TEST(LightLeak, IsNoneBehindFurniture) {
    Scene scene = lit_room();
    add_body(scene, "cupboard", Vec3(1.0, 2.0, 0.0), Vec3(2.5, 2.99, 2.0));
    add_body(scene, "bench", Vec3(0.01, 0.5, 0.0), Vec3(0.5, 2.0, 0.5));
    expect_nothing_told(scene);
}

TEST(LightLeak, IsNoneInTheOpen) {
    Scene scene = room_with_gap(2e-3);
    std::erase_if(scene.surfaces, [&](const Surface& s) {
        return scene.objects[s.object].name == "ceiling" || scene.objects[s.object].name == "south";
    });
    expect_nothing_told(scene);
}

}  // namespace
}  // namespace patchlight::light_leak_test
