#include "server/cameras_json.h"

#include "tests/server/scene_texts.h"

namespace patchlight::server::cameras_json_test {
namespace {

const std::string eye_and_target = R"("eye": [0,0,3], "look_at": [0,0,0])";

void expect_camera_rejected(const std::string& members, const std::string& pointer,
                            const std::string& words = "") {
    expect_rejected(scene_with("cameras", "[{" + members + "}]"), "/cameras/0" + pointer, words);
}

void expect_view_rejected(const std::string& members, const std::string& pointer,
                          const std::string& words = "") {
    expect_camera_rejected(eye_and_target + ", " + members, pointer, words);
}

NamedCamera camera_of(const std::string& members) {
    return read_scene_text(scene_with("cameras", "[{" + members + "}]")).cameras.at(0);
}

TEST(CamerasJson, DefaultsAreThoseOfTheContract) {
    const NamedCamera named = camera_of(eye_and_target);
    EXPECT_EQ(named.name, "#0");
    EXPECT_EQ(named.camera.vertical_fov, 40.0);
    EXPECT_EQ(named.camera.width, 512);
    EXPECT_EQ(named.camera.height, 512);
    EXPECT_EQ(named.camera.up, Vec3(0, 1, 0));
    EXPECT_EQ(named.camera.projection, raster::Projection::perspective);
    EXPECT_FALSE(named.is_made);
}

TEST(CamerasJson, EverythingGivenIsRead) {
    const NamedCamera named = camera_of(eye_and_target + R"(, "name": "main", "up": [1,0,0],
        "projection": "parallel", "height": 2.5, "size": [640,360])");
    EXPECT_EQ(named.name, "main");
    EXPECT_EQ(named.camera.view_height, 2.5);
    EXPECT_EQ(named.camera.width, 640);
    EXPECT_EQ(named.camera.height, 360);
    EXPECT_EQ(named.camera.up, Vec3(1, 0, 0));
}

TEST(CamerasJson, LengthsAreConvertedToMetres) {
    nlohmann::json scene = nlohmann::json::parse(scene_with("units", R"({"length": "mm"})"));
    scene["cameras"] = nlohmann::json::parse("[{" + eye_and_target + R"(,
        "projection": "parallel", "height": 500}])");
    const raster::Camera camera = read_scene_text(scene.dump()).cameras.at(0).camera;
    EXPECT_DOUBLE_EQ(camera.eye.z(), 0.003);
    EXPECT_DOUBLE_EQ(camera.view_height, 0.5);
}

TEST(CamerasJson, WithoutACameraOneIsMadeThatFramesTheScene) {
    const Job job = read_scene_text(scene_with("version", "1"));
    ASSERT_EQ(job.cameras.size(), 1u);
    EXPECT_TRUE(job.cameras[0].is_made);
    EXPECT_LT((job.cameras[0].camera.look_at - Vec3(0.5, 0.5, 0)).norm(), 1e-12);
}

TEST(CamerasJson, AViewNeedsADirectionAndAnUpright) {
    expect_camera_rejected(R"("look_at": [0,0,0])", "", "needs 'eye'");
    expect_camera_rejected(R"("eye": [0,0,3])", "", "needs 'look_at'");
    expect_camera_rejected(R"("eye": [1,2,3], "look_at": [1,2,3])", "/look_at", "differ");
    expect_camera_rejected(R"("eye": [0,5,0], "look_at": [0,0,0])", "", "give another 'up'");
    expect_view_rejected(R"("up": [0,0,2])", "/up", "along the view");
    expect_view_rejected(R"("up": [0,0,0])", "/up", "zero");
}

TEST(CamerasJson, WhatIsSeenMustBeFinite) {
    expect_view_rejected(R"("vertical_fov": 0)", "/vertical_fov",
                         "at least 0.001 and below 180, not 0");
    expect_view_rejected(R"("vertical_fov": 180)", "/vertical_fov");
    expect_view_rejected(R"("vertical_fov": "40")", "/vertical_fov", "must be a number");
    expect_view_rejected(R"("height": 2)", "/height", "parallel");
    expect_view_rejected(R"("projection": "parallel")", "", "needs 'height'");
    expect_view_rejected(R"("projection": "parallel", "height": 0)", "/height", "at least 1e-09");
    expect_view_rejected(R"("projection": "parallel", "height": 1, "vertical_fov": 40)",
                         "/vertical_fov", "perspective");
    expect_view_rejected(R"("projection": "fisheye")", "/projection", "known here: perspective");
}

TEST(CamerasJson, SizesAreLimited) {
    expect_view_rejected(R"("size": [100000,100000])", "/size/0", "from 1 to 16384, not 100000");
    expect_view_rejected(R"("size": [0,1])", "/size/0");
    expect_view_rejected(R"("size": [512])", "/size", "2 numbers");
    expect_view_rejected(R"("size": 512)", "/size", "must be an array");
    expect_view_rejected(R"("size": [512,1.5])", "/size/1", "whole number");
}

TEST(CamerasJson, KeysAreKnownAndNamesAreGivenOnce) {
    expect_view_rejected(R"("fov": 40)", "/fov", "did you mean 'vertical_fov'?");
    const std::string camera = "{" + eye_and_target + R"(, "name": "a"})";
    expect_rejected(scene_with("cameras", "[" + camera + "," + camera + "]"), "/cameras/1/name",
                    "'a' is given twice");
    expect_rejected(scene_with("cameras", "{}"), "/cameras", "must be an array");
}

TEST(CamerasJson, TheEchoReadsBackAsTheSame) {
    const NamedCamera named = camera_of(eye_and_target + R"(, "name": "main", "size": [64,32],
        "projection": "parallel", "height": 2)");
    const auto echo = nlohmann::json::array({nlohmann::json(camera_block(named))});
    EXPECT_EQ(camera_block(read_cameras(JsonValue(echo), 1.0).at(0)), camera_block(named));
}

}  // namespace
}  // namespace patchlight::server::cameras_json_test
