#include "server/result_json.h"

#include "tests/server/small_solution.h"

#include <gtest/gtest.h>

#include <limits>

namespace patchlight::server::result_json_test {
namespace {

using Json = nlohmann::ordered_json;

const RunReport small_run{{{"main", "image/png", 4, 3, 1.5}}, 0.1, 0.2, 0.9, 2, 5'000'000};

Json small_result() { return result_json(small_job(), small_solution(), small_run); }

TEST(ResultJson, TheShapeIsThatOfTheContract) {
    const Json result = small_result();
    std::vector<std::string> keys;
    for (const auto& [key, value] : result.items()) keys.push_back(key);
    EXPECT_EQ(
        keys,
        (std::vector<std::string>{
            "version",           "patchlight", "status", "units",        "settings",    "method",
            "patches",           "error",      "energy", "form_factors", "convergence", "objects",
            "sensors",           "grids",      "images", "findings",     "seconds",     "threads",
            "peak_memory_bytes", "result_hash"}));
}

TEST(ResultJson, QuantitiesAreWhereTheyBelong) {
    const Json result = small_result();
    EXPECT_EQ(result["status"], "converged");
    EXPECT_EQ(result["patches"], 2);
    EXPECT_EQ(result["method"].dump(),
              R"({"solver":"gauss-seidel","form_factors":"analytic","why":"small and open"})");
    EXPECT_EQ(result["energy"]["escaped"].dump(), "[189.0,190.0,191.0]");
    EXPECT_EQ(result["convergence"][1].dump(), R"({"iteration":2,"seconds":0.5,"residual":0.01})");
    EXPECT_EQ(result["objects"][1]["name"], "floor");
    EXPECT_EQ(result["objects"][1]["irradiance"].dump(), "[22.5,20.0,17.5]");
    EXPECT_EQ(result["objects"][0]["max"].dump(), "[104.0,103.0,102.0]");
    EXPECT_FALSE(result["objects"][0].contains("error")) << "too few points tell it";
    EXPECT_EQ(result["objects"][1]["error"], 0.25);
    EXPECT_EQ(result["findings"][0]["objects"][0], "floor");
    EXPECT_EQ(result["findings"][0]["count"], 3);
    EXPECT_EQ(
        result["images"][0].dump(),
        R"({"camera":"main","content_type":"image/png","width":4,"height":3,"exposure":1.5})");
    EXPECT_EQ(result["seconds"]["render"], 0.2);
}

TEST(ResultJson, TheMatrixIsReportedAsUsedAndBeforeItsRepair) {
    const Json factors = small_result()["form_factors"];
    EXPECT_EQ(factors["row_sum"]["max"], 0.4);
    EXPECT_EQ(factors["closure_max"], 0.001);
    EXPECT_EQ(factors["rays"], 1234);
    EXPECT_EQ(factors["open"], true);
    EXPECT_EQ(factors["repair"]["before"]["closure_max"], 0.01);
    EXPECT_EQ(factors["repair"]["after"]["reciprocity_max"], 1e-8);
}

TEST(ResultJson, SensorsHaveAScalarBesideTheirChannels) {
    const Json sensor = small_result()["sensors"][0];
    EXPECT_EQ(sensor["name"], "desk");
    EXPECT_EQ(sensor["position"].dump(), "[0.5,0.5,0.8]");
    EXPECT_DOUBLE_EQ(sensor["illuminance"].get<double>(), 0.2126 * 30 + 0.7152 * 20 + 0.0722 * 10);
    EXPECT_EQ(sensor["error"], 0.5);
}

TEST(ResultJson, GridsHaveTheirStatistics) {
    const Json grid = small_result()["grids"][0];
    EXPECT_EQ(grid["name"], "plane");
    EXPECT_NEAR(grid["min"].get<double>(), 10, 1e-12);
    EXPECT_NEAR(grid["mean"].get<double>(), 20, 1e-12);
    EXPECT_NEAR(grid["max"].get<double>(), 30, 1e-12);
    EXPECT_NEAR(grid["uniformity"].get<double>(), 0.5, 1e-12);
}

TEST(ResultJson, InTheDarkThereIsNoUniformity) {
    Solution solution = small_solution();
    for (SensorReport& sensor : solution.sensors) sensor.irradiance = Rgb::Zero();
    EXPECT_FALSE(result_json(small_job(), solution, small_run)["grids"][0].contains("uniformity"));
}

TEST(ResultJson, WhatIsNotKnownIsNotThere) {
    EXPECT_EQ(small_result()["error"].dump(), R"({"algebraic_bound":5e-05})");
    EXPECT_FALSE(small_result().contains("links"));
    Solution solution = small_solution();
    solution.error.target = 0.01;
    solution.error.estimate = 0.02;
    EXPECT_EQ(result_json(small_job(), solution, small_run)["error"]["met"], false);
}

TEST(ResultJson, AWorkCutShortTellsNothingItDoesNotKnow) {
    Solution solution = small_solution();
    solution.status = Status::cancelled;
    solution.convergence.clear();
    solution.sensors.clear();
    const Json result = result_json(small_job(), solution, small_run);
    EXPECT_EQ(result["status"], "cancelled");
    EXPECT_TRUE(result["grids"].empty());
    EXPECT_FALSE(result.contains("energy"));
    EXPECT_FALSE(result.contains("form_factors"));
}

TEST(ResultJson, EveryDefaultIsEchoedInSi) {
    const Json settings = small_result()["settings"];
    EXPECT_EQ(settings["units"].dump(), R"({"length":"cm","light":"photometric"})");
    EXPECT_EQ(settings["cameras"][0]["vertical_fov"], 40.0);
    EXPECT_EQ(settings["cameras"][0]["eye"].dump(), "[0.5,0.5,5.0]");
    EXPECT_EQ(settings["materials"]["grey"]["two_sided"], false);
    EXPECT_EQ(settings["solve"]["tolerance"], 1e-4);
    EXPECT_EQ(settings["solve"]["seed"], 1);
}

TEST(ResultJson, UnitsFollowTheUnitOfLight) {
    EXPECT_EQ(small_result()["units"]["irradiance"], "lx");
    EXPECT_EQ(small_result()["units"]["radiance"], "cd/m²");
    Job job = small_job();
    job.units.light = LightUnit::radiometric;
    const Json units = result_json(job, small_solution(), small_run)["units"];
    EXPECT_EQ(units["radiosity"], "W/m²");
    EXPECT_EQ(units["length"], "m");
}

TEST(ResultJson, WhatIsNotFiniteIsNeverWritten) {
    Solution solution = small_solution();
    solution.energy.backs[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(result_json(small_job(), solution, small_run), std::logic_error);
}

TEST(ResultHash, DoesNotDependOnTimeThreadsAndMemory) {
    Solution slower = small_solution();
    slower.settings.memory_limit = 123'456'789;  // chosen by the machine where it is not given
    slower.seconds.solve = 7;
    slower.convergence[0].seconds = 3;
    RunReport other = small_run;
    other.threads = 64;
    other.peak_memory = 1;
    other.total_seconds = 100;
    EXPECT_EQ(result_json(small_job(), slower, other)["result_hash"],
              small_result()["result_hash"]);
}

TEST(ResultHash, DependsOnResultsAndVertexRadiosities) {
    const auto hash = [](const Solution& solution) {
        return result_json(small_job(), solution, small_run)["result_hash"];
    };
    Solution other_residual = small_solution();
    other_residual.convergence[0].residual = 0.4;
    EXPECT_NE(hash(other_residual), hash(small_solution()));
    Solution other_vertex = small_solution();
    other_vertex.display.radiosity[2][1] += 1e-12;
    EXPECT_NE(hash(other_vertex), hash(small_solution()));
}

}  // namespace
}  // namespace patchlight::server::result_json_test
