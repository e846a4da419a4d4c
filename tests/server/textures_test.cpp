#include "raster/image_file.h"
#include "server/files/base64.h"
#include "tests/server/files/gltf_documents.h"
#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patchlight::server::textures_test {
namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Half of it white, half black, as PNG stores light: means must be of light, not of codes.
std::string half_white_png() {
    raster::Image image{4, 2, {}};
    for (int k = 0; k < 8; ++k)
        for (int c = 0; c < 3; ++c) image.rgb.push_back(k % 2 == 0 ? 1.0f : 0.0f);
    return raster::encode_png(image, 0.0);
}

/// Of one grey that lies a good way off the codes' own middle.
std::string grey_png(float light) {
    return raster::encode_png({2, 2, std::vector<float>(12, light)}, 0.0);
}

Rgb reflectance(const Job& job) {
    return job.scene.materials.at(job.scene.surfaces.at(0).material).reflectance;
}

constexpr double a_code = 0.01;  // a step of 8 bits is less than a hundredth of light

TEST(Textures, TheMeanOfThePictureTimesKdIsTheReflectance) {
    write_test_file("half.png", half_white_png());
    write_test_file("t.obj", "mtllib t.mtl\nusemtl m\n" + square + "f 1 2 3 4\n");
    for (const auto& [kd, mean] :
         {std::pair("", 0.5), std::pair("Kd 0 0 0\n", 0.5), std::pair("Kd 0.4 0.4 0.4\n", 0.2)}) {
        write_test_file("t.mtl", "newmtl m\n" + std::string(kd) + "map_Kd half.png\n");
        const Job job = scene_of_file("t.obj");
        EXPECT_NEAR(reflectance(job)[0], mean, a_code) << kd;
        EXPECT_EQ(findings_of(job.scene, "texture-averaged").size(), 1u);
        EXPECT_EQ(job.scene.findings.size(), 1u);
    }
}

TEST(Textures, OfLightAreAveragedToo) {
    write_test_file("half.png", half_white_png());
    write_test_file("t.mtl", "newmtl m\nKd 0.5\nKe 10 10 10\nmap_Ke half.png\n");
    write_test_file("t.obj", "mtllib t.mtl\nusemtl m\n" + square + "f 1 2 3 4\n");
    const Job job = scene_of_file("t.obj");
    const Rgb exitance = job.scene.materials.at(job.scene.surfaces.at(0).material).exitance;
    EXPECT_NEAR(exitance[1] / std::acos(-1.0), 5.0, 10 * a_code);
}

TEST(Textures, OfGltfAreReadFromDataAndFiles) {
    const std::string png = grey_png(0.2f);
    write_test_file("grey 2.png", png);
    GltfDocument document;
    const std::size_t points = document.square();
    document.node({{"attributes", {{"POSITION", points}}},
                   {"indices", document.accessor(bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123,
                                                 6, "SCALAR")},
                   {"material", 0}});
    document.json["materials"] = nlohmann::json::parse(
        R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0},
             "baseColorFactor": [1, 0.5, 1, 1]}}])");
    document.json["textures"] = {{{"source", 0}}};
    const std::size_t view = document.accessor(png, 5121, png.size(), "SCALAR");
    for (const nlohmann::json& image :
         {nlohmann::json{{"uri", "grey%202.png"}},
          nlohmann::json{{"uri", "data:image/png;base64," + base64_of(png)}},
          nlohmann::json{{"bufferView", view}, {"mimeType", "image/png"}}}) {
        document.json["images"] = nlohmann::json::array({image});
        write_test_file("t.gltf", document.text());
        const Job job = scene_of_file("t.gltf");
        EXPECT_NEAR(reflectance(job)[0], 0.2, a_code);
        EXPECT_NEAR(reflectance(job)[1], 0.1, a_code);
        EXPECT_EQ(findings_of(job.scene, "texture-averaged").size(), 1u);
    }
}

TEST(Textures, ThatCannotBeReadAreToldOfWithTheCause) {
    write_test_file("bad.png", grey_png(0.5f).substr(0, 40));
    write_test_file("text.png", "hello");
    write_test_file("t.obj", "mtllib t.mtl\nusemtl m\n" + square + "f 1 2 3 4\n");
    for (const auto& [name, why] :
         {std::pair("bad.png", "'bad.png'"), std::pair("text.png", "no PNG, JPEG or EXR"),
          std::pair("none.png", "is not beside"), std::pair("../x.png", "is not beside")}) {
        write_test_file("t.mtl", "newmtl m\nKd 0.3\nmap_Kd " + std::string(name) + "\n");
        const Job job = scene_of_file("t.obj");
        EXPECT_EQ(reflectance(job)[0], 0.3) << name;
        const auto told = findings_of(job.scene, "texture-ignored");
        ASSERT_EQ(told.size(), 1u) << name;
        EXPECT_NE(told[0].detail.find(why), std::string::npos) << told[0].detail;
    }
}

}  // namespace
}  // namespace patchlight::server::textures_test
