#include "solver/scene/far_reaching.h"
#include "solver/scene/local_tolerance.h"
#include "solver/solve_scene.h"
#include "tests/solver/scenes.h"

#include <gtest/gtest.h>

namespace patchlight::far_geometry_test {
namespace {

const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// What is far may change which samples are drawn, and no more: three times what other seeds do
/// at 256 rays.
constexpr double same = 1e-2;
constexpr double energy_kept = 1e-3;

/// A room of 4 m with a lamp flush in its ceiling and a table; a sensor on the table and one below.
Scene furnished() {
    Scene scene = empty_scene();
    add_box(scene, Vec3::Zero(), Vec3(4, 3, 2.7), Facing::inwards);
    add(scene, rectangle(Vec3(1.5, 1, 2.7), y, x), lamp);
    add_box(scene, Vec3(1, 1, 0.7), Vec3(2.5, 2, 0.75), Facing::outwards);
    for (const double leg : {1.1, 2.3})
        add_box(scene, Vec3(leg, 1.2, 0), Vec3(leg + 0.1, 1.3, 0.7), Facing::outwards);
    scene.sensors = {{"table", Vec3(1.7, 1.6, 0.75), z}, {"below", Vec3(1.7, 1.6, 0.0), z}};
    return scene;
}

Scene with(Scene scene, const Scene& other) {
    for (Surface surface : other.surfaces) {
        surface.object += static_cast<ObjectIndex>(scene.objects.size());
        scene.surfaces.push_back(surface);
    }
    scene.objects.insert(scene.objects.end(), other.objects.begin(), other.objects.end());
    return scene;
}

Scene with_sensors_moved(Scene scene, const Scene& of, const Motion& motion) {
    scene.sensors = of.sensors;
    for (Sensor& sensor : scene.sensors) sensor.position = motion(sensor.position);
    return scene;
}

Solution solved(Scene scene, double patch_size) {
    settle_far_geometry(scene);
    SolveSettings settings;
    settings.patch_size = patch_size;
    settings.rays = 256;
    settings.measure_error = false;
    return solve_scene(scene, settings, {});
}

class FarGeometry : public testing::Test {
  protected:
    void expect_same(const Scene& scene, double scale = 1.0) const {
        const Solution found = solved(scene, 0.8 * scale);
        ASSERT_EQ(found.sensors.size(), alone.sensors.size());
        for (std::size_t s = 0; s < alone.sensors.size(); ++s)
            EXPECT_NEAR(found.sensors[s].irradiance[0] / alone.sensors[s].irradiance[0], 1.0, same)
                << s;
        for (std::size_t k = 0; k < alone.objects.size(); ++k)
            EXPECT_NEAR(found.objects[k].irradiance[0], alone.objects[k].irradiance[0],
                        same * alone.objects[0].irradiance[0])
                << k;
        EXPECT_NEAR(found.objects[6].emitted[0] / (scale * scale), 1.0, 1e-9);
        EXPECT_LT(found.energy.defect, energy_kept);
    }

    const Scene room = furnished();
    const Solution alone = solved(room, 0.8);
};

TEST_F(FarGeometry, StrayPolygonsChangeNothing) {
    for (const double distance : {1e3, 1e5, 1e7}) {
        SCOPED_TRACE(distance);
        expect_same(with(room, scene_of(rectangle(distance * Vec3(1, 1, 0.1), x, y))));
    }
}

TEST_F(FarGeometry, AMoonChangesNothing) {
    const double radius = 1.7e6;
    expect_same(with(room, scene_of(moved(regular(12, radius), {1.0, Vec3(0, 0, 4e8)}))));
}

TEST_F(FarGeometry, AGroundOf200KilometresChangesNothing) {
    for (const double below : {0.01, 0.1})
        expect_same(with(room, scene_of(rectangle(Vec3(-1e5, -1e5, -below), 2e5 * x, 2e5 * y))));
}

TEST_F(FarGeometry, UtmCoordinatesAndAStrayVertexAtTheOriginChangeNothing) {
    const Motion motion{1.0, Vec3(5e5, 5e6, 100)};
    const Scene away = with_sensors_moved(moved(room, motion), room, motion);
    expect_same(away);
    expect_same(
        with(away, scene_of(Polygon{Vec3::Zero(), motion.shift + 9 * x, motion.shift + 9 * y})));
}

TEST_F(FarGeometry, ARoomLikeItFarAwayChangesNothing) {
    expect_same(with(room, moved(room, {1.0, Vec3(1e5, 0, 0)})));
}

TEST_F(FarGeometry, ARoomOfACentimetreInAHallOfAKilometreIsTheSame) {
    const Motion motion{1e-2 / 4.0, Vec3(300, 200, 50)};
    Scene hall = empty_scene();
    add_box(hall, Vec3::Zero(), Vec3(1000, 800, 200), Facing::inwards);
    expect_same(with(with_sensors_moved(moved(room, motion), room, motion), hall), motion.scale);
}

TEST_F(FarGeometry, ARoomOfMillimetresOrKilometresIsTheSame) {
    for (const double scale : {1e-3, 1e3}) {
        const Motion motion{scale};
        expect_same(with_sensors_moved(moved(room, motion), room, motion), scale);
    }
}

/// Solved to 0.005, which leaves sensors hardly any noise of their own.
TEST_F(FarGeometry, ChangesLuxByLessThanAThousandth) {
    const auto lux = [](Scene scene) {
        settle_far_geometry(scene);
        SolveSettings settings;
        settings.accuracy = 0.005;
        const Solution solution = solve_scene(scene, settings, {});
        EXPECT_TRUE(solution.error.met());
        std::vector<double> found;
        for (const SensorReport& sensor : solution.sensors) found.push_back(sensor.irradiance[0]);
        return found;
    };
    const std::vector<double> right = lux(room);
    const Motion motion{1.0, Vec3(5e5, 5e6, 100)};
    for (const Scene& scene :
         {with(room, scene_of(rectangle(1e5 * Vec3(1, 1, 0.1), x, y))),
          with(room, scene_of(rectangle(Vec3(-1e5, -1e5, -0.1), 2e5 * x, 2e5 * y))),
          with_sensors_moved(moved(room, motion), room, motion)}) {
        const std::vector<double> found = lux(scene);
        ASSERT_EQ(found.size(), right.size());
        for (std::size_t s = 0; s < right.size(); ++s)
            EXPECT_NEAR(found[s] / right[s], 1.0, 1e-3) << s;
    }
}

}  // namespace
}  // namespace patchlight::far_geometry_test
