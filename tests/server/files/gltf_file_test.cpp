#include "tests/server/files/gltf_documents.h"
#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

namespace patchlight::server::gltf_file_test {
namespace {

using Json = nlohmann::json;

ImportedGeometry read(const GltfDocument& document) {
    return read_written("thing.gltf", document.text());
}

/// The vertices of face number `k`, in order.
std::vector<Vec3> corners(const ImportedGeometry& geometry, std::size_t k) {
    const FileFace& face = geometry.parts.at(0).faces.at(k);
    std::vector<Vec3> found;
    for (std::uint32_t c = 0; c < face.count; ++c)
        found.push_back(geometry.vertices.at(geometry.corners.at(face.first + c)));
    return found;
}

std::vector<std::string> paths(const ImportedGeometry& geometry) {
    std::vector<std::string> listed;
    for (const FilePart& part : geometry.parts) listed.push_back(part.path);
    return listed;
}

/// The square's two triangles by way of these indices.
GltfDocument square_with_indices(const std::string& bytes, int component_type, std::size_t count,
                                 int mode = 4) {
    GltfDocument document;
    const std::size_t positions = document.square();
    const std::size_t indices = document.accessor(bytes, component_type, count, "SCALAR");
    document.node({{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"mode", mode}},
                  {{"name", "square"}});
    return document;
}

GltfDocument plain_square() {
    return square_with_indices(bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123, 6);
}

TEST(GltfFile, TrianglesAreReadFromTextAndBinary) {
    for (const auto& [name, bytes] :
         {std::pair{"a.gltf", plain_square().text()}, std::pair{"a.glb", plain_square().glb()},
          std::pair{"b.gltf", plain_square().glb()}}) {
        const ImportedGeometry geometry = read_written(name, bytes);
        EXPECT_EQ(geometry.face_count(), 2u) << name;
        EXPECT_EQ(paths(geometry), std::vector<std::string>{"square"});
        EXPECT_EQ(corners(geometry, 1)[1], Vec3(1, 1, 0));
        EXPECT_EQ(geometry.metres, 1.0);
    }
}

TEST(GltfFile, IndicesMayHaveAnyUnsignedType) {
    EXPECT_EQ(read(square_with_indices(bytes_of<std::uint8_t>({0, 1, 3}), 5121, 3)).corners,
              read(square_with_indices(bytes_of<std::uint32_t>({0, 1, 3}), 5125, 3)).corners);
}

TEST(GltfFile, StripsAndFansKeepTheirFronts) {
    for (const auto& [mode, indices] : {std::pair{5, bytes_of<std::uint16_t>({0, 1, 3, 2})},
                                        std::pair{6, bytes_of<std::uint16_t>({0, 1, 2, 3})}}) {
        const ImportedGeometry geometry = read(square_with_indices(indices, 5123, 4, mode));
        ASSERT_EQ(geometry.face_count(), 2u);
        for (std::size_t k = 0; k < 2; ++k) {
            const auto c = corners(geometry, k);
            EXPECT_GT((c[1] - c[0]).cross(c[2] - c[0]).z(), 0.5) << mode << " " << k;
        }
    }
}

TEST(GltfFile, WithoutIndicesPositionsCountInTurn) {
    GltfDocument document;
    document.node({{"attributes", {{"POSITION", document.square()}}}, {"mode", 6}});
    EXPECT_EQ(read(document).face_count(), 2u);
    EXPECT_EQ(paths(read(document)), std::vector<std::string>{"#0"});
}

TEST(GltfFile, PointsAndLinesHaveNoArea) {
    GltfDocument document = plain_square();
    document.node({{"attributes", {{"POSITION", 0}}}, {"mode", 1}}, {{"name", "wire"}});
    EXPECT_EQ(paths(read(document)), std::vector<std::string>{"square"});
}

TEST(GltfFile, NodesMoveTheirChildren) {
    GltfDocument document = plain_square();
    document.json["nodes"][0]["scale"] = {2, 2, 2};
    document.json["nodes"].push_back(
        {{"name", "up"}, {"translation", {0, 0, 5}}, {"children", {0}}});
    document.json["scenes"][0]["nodes"] = {1};
    const ImportedGeometry geometry = read(document);
    EXPECT_EQ(paths(geometry), std::vector<std::string>{"up/square"});
    EXPECT_EQ(corners(geometry, 0)[1], Vec3(2, 0, 5));
}

TEST(GltfFile, AMirroringNodeKeepsFronts) {
    GltfDocument document = plain_square();
    document.json["nodes"][0]["scale"] = {-1, 1, 1};
    const auto c = corners(read(document), 0);
    EXPECT_GT((c[1] - c[0]).cross(c[2] - c[0]).z(), 0.5);
}

TEST(GltfFile, WithoutScenesAllNodesThatAreNoChildrenShow) {
    GltfDocument document = plain_square();
    document.node({{"attributes", {{"POSITION", 0}}}, {"mode", 6}}, {{"name", "square"}});
    document.json["nodes"].push_back({{"name", "above"}, {"children", {1}}});
    document.json.erase("scene");
    document.json.erase("scenes");
    EXPECT_EQ(paths(read(document)), (std::vector<std::string>{"square", "above/square"}));
}

TEST(GltfFile, NamesThatAreGivenTwiceAreToldApart) {
    GltfDocument document = plain_square();
    for (int k = 0; k < 2; ++k)
        document.node({{"attributes", {{"POSITION", 0}}}, {"mode", 6}}, {{"name", "square"}});
    EXPECT_EQ(paths(read(document)), (std::vector<std::string>{"square", "square#2", "square#3"}));
}

TEST(GltfFile, SparseAccessorsPutOtherNumbersIn) {
    GltfDocument document;
    const std::size_t positions = document.square();
    document.accessor(bytes_of<std::uint8_t>({2}), 5121, 1, "SCALAR");
    document.accessor(bytes_of<float>({7, 8, 9}), 5126, 1, "VEC3");
    document.json["accessors"][positions]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", 1}, {"componentType", 5121}}},
        {"values", {{"bufferView", 2}}}};
    document.node({{"attributes", {{"POSITION", positions}}}, {"mode", 6}});
    EXPECT_EQ(corners(read(document), 0)[2], Vec3(7, 8, 9));
    document.json["accessors"][positions].erase("bufferView");  // the rest is zero then
    EXPECT_EQ(corners(read(document), 0)[1], Vec3(0, 0, 0));
}

TEST(GltfFile, StridesAndOffsetsCount) {
    GltfDocument document;
    const std::size_t positions =
        document.accessor(bytes_of<float>({9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0}), 5126, 3, "VEC3");
    document.json["accessors"][positions]["byteOffset"] = 4;
    document.json["bufferViews"][0]["byteStride"] = 16;
    document.node({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(corners(read(document), 0), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST(GltfFile, QuantizedPositionsAreRead) {
    GltfDocument document;
    const std::size_t positions =
        document.accessor(bytes_of<std::int8_t>({0, 0, 0, 127, 0, 0, 0, -128, 0}), 5120, 3, "VEC3");
    document.json["accessors"][positions]["normalized"] = true;
    document.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    document.node({{"attributes", {{"POSITION", positions}}}});
    EXPECT_EQ(corners(read(document), 0), (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}}));
}

TEST(GltfFile, ColourIsReflectanceAndEmissionIsRadiance) {
    GltfDocument document = plain_square();
    document.json["materials"] = Json::parse(R"([{"name": "m", "doubleSided": true,
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.25, 0.125, 0.1], "metallicFactor": 1,
                                 "baseColorTexture": {"index": 7}},
        "emissiveFactor": [1, 0.5, 0], "alphaMode": "BLEND",
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 40}}}])");
    document.json["meshes"][0]["primitives"][0]["material"] = 0;
    const ImportedGeometry geometry = read(document);
    const FileMaterial& material = geometry.materials.at(geometry.parts[0].faces[0].material);
    EXPECT_EQ(material.name, "m");
    EXPECT_TRUE((*material.reflectance == Rgb(0.5, 0.25, 0.125)).all());
    EXPECT_TRUE((material.radiance == Rgb(40, 20, 0)).all());
    EXPECT_TRUE(material.two_sided);
    EXPECT_TRUE(material.is_metal);
    EXPECT_EQ(material.reflectance_texture->problem.empty(), false);
    EXPECT_TRUE(material.is_transparent);
}

TEST(GltfFile, AMaterialThatSaysNoColourHasNone) {
    GltfDocument document = plain_square();
    document.json["materials"] = {{{"name", "m"}}};
    EXPECT_FALSE(read(document).materials.at(0).reflectance);
    EXPECT_FALSE(read(document).materials.at(0).two_sided);
    EXPECT_EQ(read(document).parts[0].faces[0].material, 1u);  // the nameless one
}

TEST(GltfFile, LightsWithoutAreaAndSkinsAreRemarkedOn) {
    GltfDocument document = plain_square();
    document.json["nodes"][0]["skin"] = 0;
    document.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const ImportedGeometry geometry = read(document);
    ASSERT_EQ(geometry.remarks.size(), 2u);
    EXPECT_EQ(geometry.remarks[0].kind, "unsupported-light");
    EXPECT_EQ(geometry.remarks[1].kind, "unsupported-skin");
}

TEST(GltfFile, BuffersMayLieBesideTheFile) {
    write_test_file("corners of it.bin", bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    GltfDocument document;
    document.node({{"attributes", {{"POSITION", document.square()}}}});
    document.json["accessors"][0]["count"] = 3;
    document.json["bufferViews"][0]["byteLength"] = 36;
    document.json["buffers"] = {{{"byteLength", 36}, {"uri", "corners%20of%20it.bin"}}};
    EXPECT_EQ(read_written("c.gltf", document.json.dump()).face_count(), 1u);
}

}  // namespace
}  // namespace patchlight::server::gltf_file_test
