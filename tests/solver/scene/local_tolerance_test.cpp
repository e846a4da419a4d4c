#include "solver/scene/local_tolerance.h"

#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::local_tolerance_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
constexpr double float_step = 0x1p-23;

Scene both(Scene scene, const Scene& other) {
    for (Surface surface : other.surfaces) {
        surface.object += static_cast<ObjectIndex>(scene.objects.size());
        scene.surfaces.push_back(surface);
    }
    scene.objects.insert(scene.objects.end(), other.objects.begin(), other.objects.end());
    return scene;
}

Scene big_room() { return moved(room_with_box(), {5.0}); }

TEST(LocalTolerance, IsAMillionthOfTheSmallerSurfaceButFourStepsOfFloatAtLeast) {
    const LocalTolerance tolerance(
        scene_of({rectangle(Vec3::Zero(), 2 * x, 2 * y), rectangle(Vec3::Zero(), x, y),
                  rectangle(Vec3::Zero(), 1e-3 * x, 1e-3 * y)}));
    EXPECT_DOUBLE_EQ(tolerance.between(0, 1), 1e-6 * std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(tolerance.between(0, 2), 4.0 * float_step);  // radius 1
    EXPECT_DOUBLE_EQ(tolerance.between(1, 2), tolerance.between(2, 1));
}

TEST(LocalTolerance, OfARoomStaysWhatItIsWhateverLiesFarAway) {
    const Scene room = big_room();
    const LocalTolerance alone(room);
    ASSERT_EQ(alone.frames().size(), 1u);
    for (const double distance : {1e4, 1e6, 1e8}) {
        const LocalTolerance tolerance(
            both(room, scene_of(rectangle(distance * Vec3(1, 1, 0), x, y))));
        EXPECT_EQ(tolerance.frames().size(), 2u) << distance;
        for (SurfaceIndex s = 0; s < room.surfaces.size(); ++s)
            EXPECT_EQ(tolerance.at(s), alone.at(s)) << distance << ": " << s;
    }
}

TEST(LocalTolerance, IsThatOfARoomAtUtmCoordinatesWithAStrayVertexAtTheOrigin) {
    const Scene room = big_room(), away = moved(room, {1.0, Vec3(5e5, 5e6, 30)});
    const Scene stray =
        scene_of(Polygon{Vec3(0, 0, 0), Vec3(5e5, 5e6, 30), Vec3(5e5, 5e6 + 1, 30)});
    const LocalTolerance alone(room), tolerance(both(away, stray));
    for (SurfaceIndex s = 0; s < room.surfaces.size(); ++s)
        EXPECT_NEAR(tolerance.at(s), alone.at(s), 1e-9) << s;  // a double's steps at 5e6
}

TEST(LocalTolerance, OfTwoRoomsFarApartIsThatOfEach) {
    const Scene room = big_room();
    const LocalTolerance alone(room), tolerance(both(room, moved(room, {1.0, Vec3(1e5, 0, 0)})));
    EXPECT_EQ(tolerance.frames().size(), 2u);
    const auto count = static_cast<SurfaceIndex>(room.surfaces.size());
    for (SurfaceIndex s = 0; s < count; ++s) {
        EXPECT_EQ(tolerance.at(s), alone.at(s)) << s;
        EXPECT_NEAR(tolerance.at(s + count), alone.at(s), 1e-12) << s;
        EXPECT_NE(tolerance.frame_of(s), tolerance.frame_of(s + count)) << s;
    }
}

TEST(LocalTolerance, KnowsASmallThingInALargeHall) {
    Scene scene = empty_scene();
    add_box(scene, Vec3::Zero(), Vec3(1000, 800, 200), Facing::inwards);
    add_box(scene, Vec3(300, 300, 50), Vec3(300.01, 300.01, 50.01), Facing::outwards);
    const LocalTolerance tolerance(scene);
    EXPECT_LT(tolerance.at(6), 1e-5 * 0.01);
    EXPECT_EQ(tolerance.at(0), 1e-6 * std::hypot(1000.0, 800.0));
    EXPECT_EQ(tolerance.frame_at(Vec3(300, 300, 50.02)), tolerance.frame_of(6));
}

TEST(LocalTolerance, OfAFinelyCutStatueIsOneWithThatOfItsRoom) {
    Scene scene = big_room();
    scene.objects.push_back({"statue"});
    const auto statue = static_cast<ObjectIndex>(scene.objects.size() - 1);
    constexpr int parts = 60;  // triangles of 5 mm, a thousandth of the room
    for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j)
            add_polygon(scene, statue, white, 0,
                        rectangle(Vec3(1 + 0.005 * i, 1 + 0.005 * j, 1), 0.005 * x, 0.005 * y), "");
    EXPECT_EQ(LocalTolerance(scene).frames().size(), 1u);
}

TEST(LocalTolerance, TakesNoMoreThanSoManyFrames) {
    Scene scene = empty_scene();
    std::mt19937 chance(1);
    for (int n = 0; n < 500; ++n)
        add(scene, rectangle(1e6 * Vec3(uniform(chance), uniform(chance), uniform(chance)), x, y));
    const LocalTolerance tolerance(scene);
    EXPECT_LE(tolerance.frames().size(), most_frames);
    EXPECT_GT(tolerance.frames().size(), most_frames / 4);
}

TEST(LocalTolerance, OfNothingIsNothing) {
    EXPECT_EQ(LocalTolerance(empty_scene()).frames().size(), 1u);
    const LocalTolerance tolerance(scene_of(rectangle(1e7 * x, y, z)));
    EXPECT_DOUBLE_EQ(tolerance.at(0), 1e-6 * std::sqrt(2.0));
}

}  // namespace
}  // namespace patchlight::local_tolerance_test
