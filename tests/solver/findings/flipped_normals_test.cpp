#include "tests/solver/findings/flawed_room.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace patchlight::flipped_normals_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
constexpr double on_the_object = 0.01;  // the place is the middle of its largest polygon [m]

void flip(Scene& scene, const std::string& name) {
    for (Surface& surface : scene.surfaces) {
        if (scene.objects[surface.object].name != name) continue;
        std::reverse(surface.corners.begin(), surface.corners.end());
        surface.normal = -surface.normal;
    }
}

TEST(FlippedNormals, AreToldOfAWallThatFacesOut) {
    Scene scene = lit_room();
    flip(scene, "east");
    expect_told(scene, "flipped-normals", {"east"}, Vec3(4.0, 1.5, 1.25), on_the_object);
}

TEST(FlippedNormals, AreToldOfABoxThatIsInsideOut) {
    Scene scene = lit_room();
    add_body(scene, "box", Vec3(1.0, 1.0, 0.3), Vec3(1.6, 1.7, 0.8), Facing::inwards);
    const std::vector<Finding> findings = told(scene);
    ASSERT_EQ(kinds(findings), "flipped-normals ");
    EXPECT_EQ(findings[0].objects, std::vector<std::string>{"box"});
    EXPECT_EQ(findings[0].count, 6u);
}

TEST(FlippedNormals, AreToldOfARoomThatIsInsideOutButForItsLamp) {
    Scene scene = lit_room();
    for (const char* wall : {"floor", "ceiling", "west", "east", "south", "north"})
        flip(scene, wall);
    for (const Finding& finding : told(scene)) EXPECT_EQ(finding.kind, "flipped-normals");
    EXPECT_GE(told(scene).size(), 5u);  // the ceiling gets no light from a lamp that shines down
}

TEST(FlippedNormals, AreNoneOfSolidsAndRoomsAsTheyShouldBe) {
    Scene scene = lit_room();
    add_body(scene, "box", Vec3(1.0, 1.0, 0.0), Vec3(1.6, 1.7, 0.5));
    add_body(scene, "shelf", Vec3(3.0, 1.0, 1.0), Vec3(3.5, 1.7, 1.05));
    add_named(scene, "screen", rectangle(Vec3(2.5, 1.0, 0.0), 0.5 * x, 1.0 * z), two_sided);
    expect_nothing_told(scene);
}

TEST(FlippedNormals, AreNoneOfAWallDrawnAsTwoOpposedPolygons) {
    Scene scene = lit_room();
    add_named(scene, "outer east", reversed(rectangle(4.0 * x, 2.5 * z, 3.0 * y)));
    expect_nothing_told(scene);
}

TEST(FlippedNormals, AreNoneInTheOpen) {
    Scene scene = empty_scene();
    add_named(scene, "ground", rectangle(Vec3(-10, -10, 0), 20 * x, 20 * y));
    add_named(scene, "sky", rectangle(Vec3(-30, -30, 20), 60 * y, 60 * x), lamp);
    for (const bool lit : {true, false}) {
        if (!lit) scene.surfaces.back().material = white;
        Scene built = scene;
        add_body(built, "house", Vec3(-2, -2, 0), Vec3(2, 2, 0.5));
        std::erase_if(built.surfaces, [](const Surface& s) {
            return s.object == 2 && s.normal.z() < -0.5;  // bottomless
        });
        EXPECT_EQ(kinds(told(built)), lit ? "" : "no-emitter ");
    }
}

}  // namespace
}  // namespace patchlight::flipped_normals_test
