#include "server/sensors_csv.h"

#include "tests/server/small_solution.h"

#include <gtest/gtest.h>

namespace patchlight::server::sensors_csv_test {
namespace {

std::string sensors_csv(const Solution& solution) {
    std::string written;
    write_sensors_csv(small_job().scene, solution, [&](std::string_view s) { written += s; });
    return written;
}

const std::string header =
    "name,x,y,z,nx,ny,nz,irradiance_r,irradiance_g,irradiance_b,scalar,error\n";

TEST(SensorsCsv, EverySensorIsARowInMetres) {
    Solution solution = small_solution();
    solution.sensors[0].irradiance = Rgb(100, 0, 0);
    solution.sensors[1].irradiance = Rgb(0, 100, 0);
    solution.sensors[2].irradiance = Rgb(0, 0, 100);
    EXPECT_EQ(sensors_csv(solution), header +
                                         "desk,0.5,0.5,0.8,0,0,1,100,0,0,21.26,0.5\n"
                                         "\"plane[0,0]\",0.25,0.5,0.8,0,0,1,0,100,0,71.52,0.1\n"
                                         "\"plane[1,0]\",0.75,0.5,0.8,0,0,1,0,0,100,7.22,0.1\n");
}

TEST(SensorsCsv, WhatWasNotGatheredIsNotThere) {
    Solution solution = small_solution();
    solution.sensors.clear();
    EXPECT_EQ(sensors_csv(solution), header);
}

}  // namespace
}  // namespace patchlight::server::sensors_csv_test
