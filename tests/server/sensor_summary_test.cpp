#include "server/sensor_summary.h"

#include "tests/server/small_solution.h"

#include <gtest/gtest.h>

namespace patchlight::server::sensor_summary_test {
namespace {

TEST(SensorSummary, PointsAndGridsHaveALineEach) {
    Solution solution = small_solution();
    solution.sensors[0].irradiance = Rgb::Constant(123.4);
    EXPECT_EQ(sensor_lines(small_job(), solution),
              "sensors:   desk 123 lx\n"
              "grid:      plane 10 to 30 lx, mean 20, uniformity 0.5\n");
}

TEST(SensorSummary, ManyAreCounted) {
    Job job = small_job();
    Solution solution = small_solution();
    for (int k = 0; k < 4; ++k) {
        job.scene.sensors.push_back(job.scene.sensors[0]);
        solution.sensors.push_back(solution.sensors[0]);
        job.scene.grids.push_back(job.scene.grids[0]);
    }
    const std::string lines = sensor_lines(job, solution);
    EXPECT_NE(lines.find(", and 2 more\ngrid: "), std::string::npos) << lines;
    EXPECT_TRUE(lines.ends_with("uniformity 0.5, and 2 more\n")) << lines;
}

TEST(SensorSummary, WhatWasNotGatheredHasNone) {
    Solution solution = small_solution();
    solution.sensors.clear();
    EXPECT_EQ(sensor_lines(small_job(), solution), "");
}

TEST(SensorSummary, InTheDarkThereIsNoUniformity) {
    Solution solution = small_solution();
    for (SensorReport& sensor : solution.sensors) sensor.irradiance = Rgb::Zero();
    EXPECT_EQ(sensor_lines(small_job(), solution),
              "sensors:   desk 0 lx\ngrid:      plane 0 to 0 lx, mean 0\n");
}

}  // namespace
}  // namespace patchlight::server::sensor_summary_test
