#include "tests/server/files/gltf_documents.h"
#include "tests/server/files/written_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace patchlight::server::gltf_extensions_test {
namespace {

using Json = nlohmann::json;

ImportedGeometry read(const GltfDocument& document) {
    return read_written("thing.gltf", document.text());
}

GltfDocument plain_square(const Json& more = {}) {
    GltfDocument document;
    const std::size_t points = document.square();
    const std::size_t corners =
        document.accessor(bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123, 6, "SCALAR");
    document.node({{"attributes", {{"POSITION", points}}}, {"indices", corners}}, more);
    return document;
}

std::string kinds(const ImportedGeometry& geometry) {
    std::string all;
    for (const Finding& remark : geometry.remarks) all += remark.kind + " ";
    return all;
}

/// godotengine/godot#38335, atteneder/glTFast#241: such a model came out white.
TEST(GltfExtensions, DiffuseColourOfSpecularGlossinessIsRead) {
    GltfDocument document = plain_square();
    document.json["materials"] = Json::parse(R"([{"pbrMetallicRoughness": {"metallicFactor": 1},
        "extensions": {"KHR_materials_pbrSpecularGlossiness":
            {"diffuseFactor": [0.8, 0.6, 0.4, 1], "diffuseTexture": {"index": 3}}}}])");
    document.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
    const FileMaterial material = read(document).materials.at(0);
    EXPECT_TRUE((material.reflectance.value() == Rgb(0.8, 0.6, 0.4)).all());
    EXPECT_TRUE(material.reflectance_texture.has_value());
    EXPECT_FALSE(material.is_metal);
}

TEST(GltfExtensions, TransmissionLetsLightThrough) {
    const auto is_transparent = [](const std::string& extensions) {
        GltfDocument document = plain_square();
        document.json["materials"] = Json::parse("[{\"extensions\": " + extensions + "}]");
        return read(document).materials.at(0).is_transparent;
    };
    EXPECT_TRUE(is_transparent(R"({"KHR_materials_transmission": {"transmissionFactor": 0.5}})"));
    EXPECT_TRUE(is_transparent(
        R"({"KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5}})"));
    EXPECT_FALSE(is_transparent(R"({"KHR_materials_transmission": {"transmissionFactor": 0}})"));
    EXPECT_FALSE(is_transparent(R"({"KHR_materials_ior": {"ior": 1.4}})"));
}

/// KhronosGroup/UnityGLTF#696, atteneder/glTFast#107.
TEST(GltfExtensions, EveryInstanceIsAnObject) {
    GltfDocument document = plain_square();
    const std::size_t moves =
        document.accessor(bytes_of<float>({0, 0, 0, 2, 0, 0, 4, 0, 0}), 5126, 3, "VEC3");
    const std::size_t scales =
        document.accessor(bytes_of<float>({1, 1, 1, 2, 2, 2, -1, 1, 1}), 5126, 3, "VEC3");
    const auto half = static_cast<float>(std::sqrt(0.5));
    const std::size_t turns = document.accessor(
        bytes_of<float>({0, 0, 0, 1, 0, 0, half, half, 0, 0, 0, 1}), 5126, 3, "VEC4");
    Json& node = document.json["nodes"][0];
    node["name"] = "tile";
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", moves}, {"SCALE", scales}, {"ROTATION", turns}};
    document.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const ImportedGeometry tiles = read(document);
    ASSERT_EQ(tiles.parts.size(), 3u);
    EXPECT_EQ(tiles.parts[1].path, "tile/#1");
    constexpr double float_steps = 1e-6;
    const auto corner = [&](std::size_t part, std::size_t k) {
        return tiles.vertices[tiles.corners[tiles.parts[part].faces[0].first + k]];
    };
    EXPECT_LE((corner(1, 1) - Vec3(2, 2, 0)).norm(), float_steps);  // (1, 0, 0) doubled and turned
    const Vec3 mirrored = (corner(2, 1) - corner(2, 0)).cross(corner(2, 2) - corner(2, 0));
    EXPECT_GT(mirrored.z(), 0.0);  // its front is still its front
    EXPECT_EQ(kinds(tiles), "");
}

TEST(GltfExtensions, InstancesThatDoNotAddUpAreRefused) {
    GltfDocument document = plain_square();
    const std::size_t two = document.accessor(bytes_of<float>({0, 0, 0, 1, 1, 1}), 5126, 2, "VEC3");
    Json& attributes =
        document.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes = {{"TRANSLATION", two}, {"SCALE", 0}};
    expect_file_rejected("thing.gltf", document.text(), "instances, another attribute");
    attributes = Json::object();
    expect_file_rejected("thing.gltf", document.text(), "needs 'TRANSLATION'");
}

TEST(GltfExtensions, HiddenNodesAndWhatIsBelowThemAreLeftOutAndToldOf) {
    GltfDocument document = plain_square();
    document.node(document.json["meshes"][0]["primitives"][0]);
    document.json["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    document.json["nodes"][0]["children"] = {1};
    document.json["scenes"][0]["nodes"] = {0};
    expect_file_rejected("thing.gltf", document.text(), "no triangles that are shown");
    document.json["nodes"][0].erase("children");
    document.json["scenes"][0]["nodes"] = {0, 1};
    const ImportedGeometry shown = read(document);
    EXPECT_EQ(shown.parts.size(), 1u);
    EXPECT_EQ(kinds(shown), "hidden-left-out ");
}

/// mrdoob/three.js#11796, CesiumGS/cesium#9666.
TEST(GltfExtensions, MorphTargetsMoveVerticesByTheirWeights) {
    GltfDocument document = plain_square();
    const std::size_t up =
        document.accessor(bytes_of<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}), 5126, 4, "VEC3");
    Json& mesh = document.json["meshes"][0];
    mesh["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"NORMAL", up}}};
    const auto height = [&] { return read(document).vertices.at(0).z(); };
    EXPECT_EQ(height(), 0.0);
    mesh["weights"] = {0.5, 1.0};
    EXPECT_EQ(height(), 0.5);
    document.json["nodes"][0]["weights"] = {2.0, 0.0};
    EXPECT_EQ(height(), 2.0);
}

TEST(GltfExtensions, WhatIsNotReadIsToldOfAndRefusedWhereItIsRequired) {
    GltfDocument document = plain_square();
    document.json["extensionsUsed"] = {"KHR_materials_unlit", "MSFT_lod", "KHR_materials_ior",
                                       "KHR_texture_transform"};
    document.json["animations"] = {{{"channels", Json::array()}}};
    document.json["scenes"].push_back(Json::object());
    const ImportedGeometry told = read(document);
    EXPECT_EQ(kinds(told), "unsupported-extension animation-ignored scenes-ignored ");
    EXPECT_NE(told.remarks[0].detail.find("'KHR_materials_unlit', 'MSFT_lod'"), std::string::npos);
    EXPECT_EQ(told.remarks[0].detail.find("ior"), std::string::npos);
    document.json["extensionsRequired"] = {"MSFT_lod"};
    expect_file_rejected("thing.gltf", document.text(), "requires the extension 'MSFT_lod'");
}

TEST(GltfExtensions, DataThatIsThereCompressedAloneIsRefusedByName) {
    GltfDocument document = plain_square();
    document.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] =
        Json::object();
    EXPECT_EQ(read(document).face_count(), 2u);  // what is beside it is read
    document.json["accessors"][0].erase("bufferView");
    expect_file_rejected("thing.gltf", document.text(), "KHR_draco_mesh_compression");
}

TEST(GltfExtensions, ColoursOfVerticesAreToldOfUnlessTheyAreWhite) {
    GltfDocument document = plain_square();
    const std::size_t white =
        document.accessor(bytes_of<float>({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}), 5126, 4, "VEC3");
    const std::size_t red =
        document.accessor(bytes_of<float>({1, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1}), 5126, 4, "VEC3");
    Json& attributes = document.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["COLOR_0"] = white;
    EXPECT_EQ(kinds(read(document)), "");
    attributes["COLOR_0"] = red;
    EXPECT_EQ(kinds(read(document)), "colours-ignored ");
}

TEST(GltfCameras, AreThoseOfASceneThatGivesNone) {
    GltfDocument document = plain_square();
    document.json["cameras"] = Json::parse(R"([
        {"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1, "aspectRatio": 2}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 2, "znear": 0, "zfar": 9}}])");
    const auto half = static_cast<float>(std::sqrt(0.5));
    document.json["nodes"].push_back({{"name", "shot"},
                                      {"camera", 0},
                                      {"translation", {1, 2, 3}},
                                      {"rotation", {half, 0, 0, half}}});
    document.json["nodes"].push_back({{"name", "plan"}, {"camera", 1}});
    document.json["scenes"][0]["nodes"] = {0, 1, 2};
    read_written("thing.gltf", document.text());
    const Job job = scene_of_file("thing.gltf", R"("translation": [10, 0, 0])");
    ASSERT_EQ(job.cameras.size(), 2u);
    const raster::Camera& shot = job.cameras[0].camera;
    EXPECT_EQ(job.cameras[0].name, "shot");
    EXPECT_NEAR(shot.vertical_fov, 0.7 * 180 / std::numbers::pi, 1e-9);
    constexpr double float_steps = 1e-6;
    EXPECT_LE((shot.eye - Vec3(11, 2, 3)).norm(), float_steps);
    EXPECT_LE((shot.look_at - shot.eye - Vec3(0, 1, 0)).norm(), float_steps);  // -z, turned up
    EXPECT_EQ(shot.width, 512);
    EXPECT_EQ(shot.height, 256);
    const raster::Camera& plan = job.cameras[1].camera;
    EXPECT_EQ(plan.projection, raster::Projection::parallel);
    EXPECT_EQ(plan.view_height, 4.0);
    EXPECT_EQ(plan.width, 256);
    const Job own =
        scene_of_file("thing.gltf", "", R"("cameras": [{"eye": [0, 0, 5], "look_at": [0, 0, 0]}])");
    EXPECT_EQ(own.cameras.size(), 1u);
}

}  // namespace
}  // namespace patchlight::server::gltf_extensions_test
