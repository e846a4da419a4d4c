#include "server/chart/chart_truth.h"

#include "server/chart/chart_method.h"
#include "server/scene_json.h"
#include "solver/solve_scene.h"
#include "tests/server/small_box.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <set>

namespace patchlight::server::chart_truth_test {
namespace {

/// The small box with changes merged in (RFC 7396).
Job box(const std::string& changes) {
    nlohmann::json scene = nlohmann::json::parse(small_box);
    scene.merge_patch(nlohmann::json::parse(changes));
    return read_scene_text(scene.dump());
}

/// All surfaces alike: radiosity is 1 / (1 - 0.5) = 2 everywhere.
Job furnace() {
    return box(R"({"materials": {"white": {"reflectance": 0.5, "exitance": 1},
                                 "lamp": {"reflectance": 0.5, "radiance": null, "exitance": 1,
                                          "two_sided": true}}})");
}

Solution solve(const Job& job) { return solve_scene(job.scene, job.settings, {}); }

TEST(ChartTruth, OfAFurnaceTheAnswerIsKnown) {
    constexpr double closure = 1e-4;  // of the matrix, and the sweeps' tolerance
    const Job job = furnace();
    const ChartTruth truth(job.scene, solve(job));
    EXPECT_TRUE(truth.is_known());
    EXPECT_NEAR(truth.level(), 1.0, 1e-9);  // of the light sent back
    ASSERT_TRUE(truth.error_of(solve(job)));
    EXPECT_LT(*truth.error_of(solve(job)), closure);
    Solution off = solve(job);
    for (Rgb& radiosity : off.display.radiosity) radiosity = Rgb::Constant(2.25);
    EXPECT_NEAR(*truth.error_of(off), 0.25, 1e-9);
}

TEST(ChartTruth, WhereLightIsLostOrSurfacesDifferItIsNot) {
    const Job open = read_scene_text(R"({"version": 1,
        "materials": {"white": {"reflectance": 0.5, "exitance": 1}},
        "objects": [
          {"name": "a", "material": "white", "polygon": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]]},
          {"name": "b", "material": "white", "polygon": [[0,0,1],[0,1,1],[1,1,1],[1,0,1]]}],
        "solve": {"patch_size": 0.5}})");
    const Job unlike = box("{}");
    EXPECT_FALSE(known_radiosity(open.scene, solve(open)));
    EXPECT_FALSE(known_radiosity(unlike.scene, solve(unlike)));
}

TEST(ChartTruth, ASolutionIsFreeOfErrorAgainstItself) {
    const Job job = box("{}");
    const Solution solution = solve(job);
    const ChartTruth truth(job.scene, solution);
    EXPECT_FALSE(truth.is_known());
    EXPECT_FALSE(truth.is_at_sensors());
    EXPECT_LT(*truth.error_of(solution), 1e-12);
}

TEST(ChartTruth, WhereNothingReflectsSensorsCount) {
    const Job job = box(R"({"materials": {"white": {"reflectance": 0},
                                          "lamp": {"reflectance": 0, "radiance": 5}},
                            "objects": [{"name": "lamp", "material": "lamp", "polygon":
                              [[0.7,0.7,1.9],[0.7,1.3,1.9],[1.3,1.3,1.9],[1.3,0.7,1.9]]}]})");
    Solution solution = solve(job);
    const ChartTruth truth(job.scene, solution);
    EXPECT_TRUE(truth.is_at_sensors());
    solution.sensors.at(0).irradiance *= 1.5;
    EXPECT_NEAR(truth.error_of(solution).value_or(-1.0), 0.5, 1e-9);
}

TEST(ChartMethods, CoverEverySeriesAndAreSetAsTheySay) {
    const Job job = box("{}");
    std::set<SeriesIndex> series;
    for (const ChartMethod& method : chart_methods(job.scene, job.settings)) {
        series.insert(method.series);
        EXPECT_EQ(method.settings.method, all_series.at(method.series).method);
        EXPECT_EQ(method.settings.engine, all_series.at(method.series).engine);
        EXPECT_EQ(method.settings.accuracy.has_value(), method.series == automatic_series);
        EXPECT_GT(method.cost.seconds, 0.0);
        EXPECT_FALSE(setting_text(method).empty());
    }
    EXPECT_EQ(series.size(), all_series.size());
}

TEST(ChartMethods, MeshesThatCannotBeCoarserAreNotChartedTwice) {
    nlohmann::json faces = nlohmann::json::array(), vertices = nlohmann::json::array();
    for (int k = 0; k < 4000; ++k) {  // triangles far apart: none can be left out
        for (const double corner : {0.0, 1.0, 2.0})
            vertices.push_back({3.0 * k + corner, corner == 1.0 ? 1.0 : 0.0, 0.0});
        faces.push_back({3 * k, 3 * k + 2, 3 * k + 1});
    }
    nlohmann::json scene = nlohmann::json::parse(small_box);
    scene["objects"] = {{{"name", "row"},
                         {"material", "lamp"},
                         {"mesh", {{"vertices", vertices}, {"faces", faces}}}}};
    const Job job = read_scene_text(scene.dump());
    std::set<std::size_t> patches;
    for (const ChartMethod& method : chart_methods(job.scene, job.settings))
        if (method.series != automatic_series) patches.insert(method.cost.patches);
    EXPECT_LE(patches.size(), 2u);
}

}  // namespace
}  // namespace patchlight::server::chart_truth_test
