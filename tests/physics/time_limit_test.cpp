#include "solver/solve_scene.h"
#include "tests/physics/rooms.h"
#include "tests/solver/solutions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patchlight::time_limit_test {
namespace {

/// A ball of 2 n² quads, as triangles, that hangs in a room, and a plane of sensors.
Scene ball_in_a_room(int n) {
    SceneBuilder builder;
    const MaterialIndex grey = builder.material(0.6, 0.0), lit = builder.material(0.5, 20.0);
    const auto at = [n](int i, int j) {
        const double t = std::numbers::pi * j / n, p = std::numbers::pi * i / n;
        return Vec3(2.0 + 0.7 * std::sin(t) * std::cos(p), 2.0 + 0.7 * std::sin(t) * std::sin(p),
                    1.2 + 0.7 * std::cos(t));
    };
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < 2 * n; ++i) {
            if (j + 1 < n)
                builder.polygon("ball", grey, {at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            if (j > 0) builder.polygon("ball", grey, {at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    builder.polygon("floor", grey, {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}});
    builder.polygon("ceiling", grey, {{0, 0, 3}, {0, 4, 3}, {4, 4, 3}, {4, 0, 3}});
    builder.polygon("wall", grey, {{0, 0, 0}, {0, 4, 0}, {0, 4, 3}, {0, 0, 3}});
    builder.polygon("lamp", lit, {{3, 3, 2.9}, {3, 3.5, 2.9}, {3.5, 3.5, 2.9}, {3.5, 3, 2.9}});
    for (int k = 0; k < 20; ++k) builder.sensor({0.2 + 0.18 * k, 0.5, 0.8}, Vec3::UnitZ());
    return builder.scene;
}

/// Whatever a limit leaves, it is whole: once there is light on display there is light at all
/// sensors, and an estimate.
TEST(TimeLimit, LeavesAllSensorsAndAnEstimateOnceThereIsLight) {
    const Scene scene = ball_in_a_room(60);
    for (const double seconds : {0.05, 0.2, 0.4, 0.8, 1.6}) {
        SCOPED_TRACE(seconds);
        SolveSettings settings;
        settings.accuracy = 0.002;
        settings.time_limit = seconds;
        const Solution solution = solve_scene(scene, settings, {});
        EXPECT_EQ(solution.status, Status::limit);
        EXPECT_FALSE(solution.display.triangles.empty());
        ASSERT_TRUE(solution.error.estimate);
        EXPECT_GT(*solution.error.estimate, 0.002);
        if (solution.sensors.empty()) continue;  // it ended before there was light
        ASSERT_EQ(solution.sensors.size(), scene.sensors.size());
        for (const SensorReport& sensor : solution.sensors) {
            EXPECT_GT(luminance(sensor.irradiance), 0.0);
            EXPECT_GT(sensor.error, 0.0);
        }
    }
}

}  // namespace
}  // namespace patchlight::time_limit_test
