#include "tests/server/http/raw_client.h"
#include "tests/server/http/test_service.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace patchlight::server::bad_scenes_test {
namespace {

class BadScenes : public testing::Test {
  protected:
    /// The problem that a scene is answered with.
    nlohmann::json problem(const std::string& scene, int status) {
        const RawAnswer answer = ask(service_.port(), post("/v1/render", scene));
        EXPECT_EQ(answer.status, status) << scene.substr(0, 200) << "\n"
                                         << answer.body.substr(0, 500);
        EXPECT_EQ(answer.field("content-type"), "application/problem+json");
        return nlohmann::json::parse(answer.body, nullptr, false);
    }

    void expect_kind(const std::string& scene, int status, const std::string& kind) {
        const auto document = problem(scene, status);
        EXPECT_EQ(document.value("type", ""), "urn:patchlight:" + kind) << scene.substr(0, 200);
        EXPECT_EQ(document.value("status", 0), status);
    }

    void expect_pointer(const std::string& scene, const std::string& pointer) {
        const auto document = problem(scene, 422);
        EXPECT_EQ(document.value("pointer", "none"), pointer) << document.dump();
        ASSERT_FALSE(document["errors"].empty());
        EXPECT_EQ(document["errors"][0]["pointer"], pointer);
        EXPECT_EQ(document["errors"][0]["detail"], document["detail"]);
    }

    /// The quick scene with a member of it replaced.
    static std::string scene_with(const std::string& pointer, const nlohmann::json& value) {
        auto scene = nlohmann::json::parse(quick_scene());
        scene[nlohmann::json::json_pointer(pointer)] = value;
        return scene.dump();
    }

    static ServiceSettings settings() {
        ServiceSettings small;
        small.render.patches = 1000;
        small.render.pixels = 10'000;
        small.render.sensors = 10;
        small.render.rays = 1000;
        return small;
    }

    TestService service_{settings()};
};

TEST_F(BadScenes, BytesThatAreNoJson) {
    expect_kind("", 400, "json-syntax");
    expect_kind("   ", 400, "json-syntax");
    expect_kind(R"({"a": NaN})", 400, "json-syntax");
    expect_kind(R"({"a": Infinity})", 400, "json-syntax");
    expect_kind("{} {}", 400, "json-syntax");
    expect_kind(R"({"size": 1e999})", 400, "json-number-range");
    expect_kind("{\"a\": \"\xff\"}", 400, "json-encoding");
    expect_kind(R"({"a": "\ud800"})", 400, "json-encoding");
    expect_kind(std::string("{}\0", 3), 400, "json-encoding");
    expect_kind(std::string("\xff\xfe{\0}\0", 6), 400, "json-encoding");
    expect_kind(R"({"version": 1, "version": 1})", 400, "json-duplicate-key");
    expect_kind(std::string(1'000'000, '['), 400, "json-too-deep");
}

TEST_F(BadScenes, TheByteWhereJsonEndsIsTold) {
    const auto document = problem(R"({"a":)", 400);
    EXPECT_EQ(document["offset"], 5);
    EXPECT_EQ(document["line"], 1);
    EXPECT_EQ(document["column"], 6);
}

TEST_F(BadScenes, JsonThatIsNoScene) {
    expect_pointer("[]", "");
    expect_pointer("\"x\"", "");
    expect_pointer("{}", "");
    expect_pointer(scene_with("/materials/white", {{"reflectance", 1.0}}),
                   "/materials/white/reflectance");
    expect_pointer(scene_with("/materials/white", {{"reflectance", -0.1}}),
                   "/materials/white/reflectance");
    expect_pointer(scene_with("/materials/white", {{"emision", 1}}), "/materials/white/emision");
    expect_pointer(scene_with("/objects/0/polygon/1", nullptr), "/objects/0/polygon/1");
    expect_pointer(scene_with("/objects/0/polygon/1/0", 1e30), "/objects/0/polygon/1/0");
    expect_pointer(scene_with("/objects", nlohmann::json::array()), "/objects");
    expect_pointer(scene_with("/cameras/0/vertical_fov", 180), "/cameras/0/vertical_fov");
    expect_pointer(scene_with("/objects/0", {{"name", "room"}, {"file", "/etc/passwd"}}),
                   "/objects/0/file");
    const auto mesh = nlohmann::json::parse(
        R"({"name": "m", "material": "white",
            "mesh": {"vertices": [[0,0,0],[1,0,0],[0,1,0]], "faces": [[0,1,99]]}})");
    expect_pointer(scene_with("/objects/0", mesh), "/objects/0/mesh/faces/0/2");
}

TEST_F(BadScenes, SeveralMistakesAreToldTogether) {
    auto scene = nlohmann::json::parse(quick_scene());
    scene["cameras"][1]["size"] = {0, 0};
    scene["solve"]["rays"] = -1;
    scene["materials"]["white"] = {{"reflectance", 2}};
    const auto document = problem(scene.dump(), 422);
    EXPECT_EQ(document["errors"].size(), 3U) << document.dump(2);
    EXPECT_EQ(document["pointer"], document["errors"][0]["pointer"]);
}

TEST_F(BadScenes, MoreThanTheServerGives) {
    const auto sensors = nlohmann::json::parse(
        R"([{"name": "g", "grid": {"origin": [0,0,0.5], "u": [1,0,0], "v": [0,1,0],
             "count": [20, 20]}, "normal": [0,0,1]}])");
    expect_kind(scene_with("/cameras/0/size", {101, 100}), 422, "image-too-large");
    expect_kind(scene_with("/sensors", sensors), 422, "too-many-sensors");
    expect_kind(scene_with("/solve/rays", 1001), 422, "too-many-rays");
    expect_kind(scene_with("/solve/patch_size", 1e-6), 422, "too-many-patches");
    const auto document = problem(scene_with("/solve/patch_size", 0.01), 422);
    EXPECT_EQ(document["pointer"], "/solve/patch_size");
    EXPECT_EQ(document["limit"], 1000);
    EXPECT_GE(document["asked"], 20'000);
}

TEST_F(BadScenes, MoreMemoryThanThereMayBe) {
    const auto document = problem(scene_with("/solve/memory_limit", 1000), 422);
    EXPECT_NE(document["detail"].get<std::string>().find("1000 bytes"), std::string::npos);
}

TEST_F(BadScenes, ASceneWithoutLightIsDark) {
    const std::string dark = scene_with("/materials/lamp", {{"reflectance", 0.5}});
    const RawAnswer answer = ask(
        service_.port(),
        post("/v1/render", dark, "Content-Type: application/json\r\nAccept: application/json\r\n"));
    EXPECT_EQ(answer.status, 200);
    EXPECT_NE(answer.body.find("no-emitter"), std::string::npos);
}

}  // namespace
}  // namespace patchlight::server::bad_scenes_test
