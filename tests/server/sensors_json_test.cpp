#include "tests/server/scene_texts.h"

namespace patchlight::server::sensors_json_test {
namespace {

void expect_sensor_rejected(const std::string& members, const std::string& pointer,
                            const std::string& words = "") {
    expect_rejected(scene_with("sensors", "[{" + members + "}]"), "/sensors/0" + pointer, words);
}

Scene scene_of(const std::string& sensors) {
    return read_scene_text(scene_with("sensors", sensors)).scene;
}

TEST(SensorsJson, APointHasAPlaceAndAUnitNormal) {
    const Scene scene = scene_of(R"([{"name": "desk", "position": [1,2,3], "normal": [0,0,5]}])");
    ASSERT_EQ(scene.sensors.size(), 1u);
    EXPECT_EQ(scene.sensors[0].name, "desk");
    EXPECT_EQ(scene.sensors[0].position, Vec3(1, 2, 3));
    EXPECT_EQ(scene.sensors[0].normal, Vec3(0, 0, 1));
}

TEST(SensorsJson, GridPointsAreCellCentresWithURunningFastest) {
    const Scene scene = scene_of(R"([
        {"name": "first", "position": [0,0,1], "normal": [0,0,1]},
        {"name": "plane", "normal": [0,0,1],
         "grid": {"origin": [10,20,1], "u": [4,0,0], "v": [0,3,0], "count": [2,3]}}])");
    ASSERT_EQ(scene.sensors.size(), 7u);
    ASSERT_EQ(scene.grids.size(), 1u);
    EXPECT_EQ(scene.grids[0].first, 1u);
    EXPECT_EQ(scene.grids[0].count_u, 2);
    EXPECT_EQ(scene.grids[0].count_v, 3);
    const Sensor& right_of_the_second_row = scene.sensors[1 + 1 * 2 + 1];
    EXPECT_EQ(right_of_the_second_row.name, "plane[1,1]");
    EXPECT_EQ(right_of_the_second_row.position, Vec3(13, 21.5, 1));
    EXPECT_EQ(scene.sensors[2].name, "plane[1,0]");
}

TEST(SensorsJson, LengthsAreConvertedToMetres) {
    nlohmann::json scene = nlohmann::json::parse(scene_with("units", R"({"length": "mm"})"));
    scene["sensors"] = nlohmann::json::parse(R"([{"position": [0,0,1500], "normal": [0,0,1]}])");
    const Scene read = read_scene_text(scene.dump()).scene;
    EXPECT_EQ(read.sensors[0].position.z(), 1.5);
    EXPECT_EQ(read.sensors[0].name, "#0");
}

TEST(SensorsJson, ALineOfSensorsMayLackOneSide) {
    EXPECT_EQ(scene_of(R"([{"normal": [0,0,1], "grid": {"origin": [0,0,1], "u": [1,0,0],
                           "v": [0,0,0], "count": [5,1]}}])")
                  .sensors.size(),
              5u);
}

TEST(SensorsJson, WhatIsMissingOrUnknownIsRefused) {
    expect_sensor_rejected(R"("position": [0,0,1])", "", "needs 'normal'");
    expect_sensor_rejected(R"("normal": [0,0,1])", "", "'position' and 'grid'");
    expect_sensor_rejected(R"("position": [0,0,1], "normal": [0,0,1], "grid": {})", "",
                           "'position' and 'grid'");
    expect_sensor_rejected(R"("position": [0,0,1], "normal": [0,0,0])", "/normal", "zero");
    expect_sensor_rejected(R"("position": [0,0,1], "normals": [0,0,1])", "/normals",
                           "did you mean 'normal'?");
    expect_sensor_rejected(R"("position": [0,1e12,1], "normal": [0,0,1])", "/position", "1e9 m");
    expect_rejected(scene_with("sensors", "{}"), "/sensors", "must be an array");
    expect_rejected(scene_with("sensors", "[3]"), "/sensors/0", "must be an object");
}

TEST(SensorsJson, GridsAreChecked) {
    const auto grid = [](const std::string& count, const std::string& u) {
        return R"("normal": [0,0,1], "grid": {"origin": [0,0,1], "v": [0,1,0], "u": )" + u +
               R"(, "count": )" + count + "}";
    };
    expect_sensor_rejected(grid("[0,1]", "[1,0,0]"), "/grid/count/0", "from 1 to 10000, not 0");
    expect_sensor_rejected(grid("[1,2.5]", "[1,0,0]"), "/grid/count/1", "whole number");
    expect_sensor_rejected(grid("[1]", "[1,0,0]"), "/grid/count", "2 numbers");
    expect_sensor_rejected(grid("[2,2]", "[0,0,0]"), "/grid/u", "must not be zero");
    expect_sensor_rejected(grid("[10000,10000]", "[1,0,0]"), "",
                           "100000000 sensors; the limit is 1000000");
    expect_sensor_rejected(R"("normal": [0,0,1], "grid": {"origin": [0,0,1]})", "/grid",
                           "needs 'count'");
}

TEST(SensorsJson, NamesAreGivenOnce) {
    const std::string sensor = R"({"name": "s", "position": [0,0,1], "normal": [0,0,1]})";
    expect_rejected(scene_with("sensors", "[" + sensor + "," + sensor + "]"), "/sensors/1",
                    "'s' is given twice");
    expect_rejected(scene_with("sensors", R"([
        {"name": "p[0,0]", "position": [0,0,1], "normal": [0,0,1]},
        {"name": "p", "normal": [0,0,1], "grid": {"origin": [0,0,1], "u": [1,0,0], "v": [0,1,0],
                                                  "count": [1,1]}}])"),
                    "/sensors/1", "'p[0,0]' is given twice");
}

}  // namespace
}  // namespace patchlight::server::sensors_json_test
