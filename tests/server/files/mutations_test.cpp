#include "server/files/geometry_file.h"
#include "solver/scene/input_error.h"
#include "tests/server/files/gltf_documents.h"
#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

#include <random>

namespace patchlight::server::mutations_test {
namespace {

/// Bytes with something changed, left out, put in or cut off.
std::string mutated(std::string bytes, std::mt19937& chance) {
    const char* const oddities[] = {"nan", "-1", "0", "1e30", "4294967295",
                                    "\"",  "[",  "{", "null", "//"};
    for (std::size_t k = 1 + chance() % 3; k > 0 && !bytes.empty(); --k) {
        const std::size_t at = chance() % bytes.size();
        switch (chance() % 4) {
            case 0:
                bytes[at] = static_cast<char>(chance());
                break;
            case 1:
                bytes.erase(at, 1 + chance() % 8);
                break;
            case 2:
                bytes.replace(at, chance() % 3, oddities[chance() % std::size(oddities)]);
                break;
            default:
                bytes.resize(at);
        }
    }
    return bytes;
}

void expect_sound(const ImportedGeometry& geometry) {
    for (const FilePart& part : geometry.parts)
        for (const FileFace& face : part.faces) {
            ASSERT_LT(face.material, geometry.materials.size());
            ASSERT_LE(face.first + face.count, geometry.corners.size());
            for (std::uint32_t k = face.first; k < face.first + face.count; ++k)
                ASSERT_LT(geometry.corners[k], geometry.vertices.size());
        }
}

/// Each mutant is read soundly or refused with its name.
void expect_mutants_survived(const std::string& name, const std::string& bytes) {
    constexpr int mutants = 400;
    std::mt19937 chance(1);
    int refused = 0;
    for (int k = 0; k < mutants; ++k) {
        try {
            expect_sound(read_written(name, mutated(bytes, chance)));
        } catch (const InputError& error) {
            EXPECT_TRUE(error.pointer().starts_with(name) || error.pointer().starts_with("m.mtl"))
                << error.pointer() << ": " << error.what();
            ++refused;
        }
    }
    EXPECT_GT(refused, mutants / 10);  // so the mutations do harm
    EXPECT_LT(refused, mutants);
}

GltfDocument square() {
    GltfDocument document;
    const std::size_t positions = document.square();
    const std::size_t indices =
        document.accessor(bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123, 6, "SCALAR");
    document.node({{"attributes", {{"POSITION", positions}}}, {"indices", indices}},
                  {{"name", "square"}, {"rotation", {0, 0, 0, 1}}});
    return document;
}

TEST(Mutations, OfObj) {
    write_test_file("m.mtl", "newmtl m\nKd 0.5 0.5 0.5\n");
    expect_mutants_survived(
        "m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no a\ng b\n"
        "usemtl m\nf 1 2 3 4\nf -4//1 -3//1 -2//1\ng c\nf 1/1/1 2/2/2 \\\n 4/4/4\n");
}

TEST(Mutations, OfGltf) { expect_mutants_survived("m.gltf", square().text()); }

TEST(Mutations, OfGlb) { expect_mutants_survived("m.glb", square().glb()); }

TEST(Mutations, OfGltfWithExtensions) {
    GltfDocument document = square();
    const std::size_t moves =
        document.accessor(bytes_of<float>({0, 0, 0, 2, 0, 0}), 5126, 2, "VEC3");
    nlohmann::json& node = document.json["nodes"][0];
    node["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", moves}}}}},
                          {"KHR_node_visibility", {{"visible", true}}}};
    node["camera"] = 0;
    node["weights"] = {0.5};
    document.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
    document.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 0;
    document.json["meshes"][0]["primitives"][0]["material"] = 0;
    document.json["cameras"] = {{{"perspective", {{"yfov", 1}}}}};
    document.json["images"] = {{{"bufferView", 0}}};
    document.json["textures"] = {{{"source", 0}}};
    document.json["materials"] = nlohmann::json::parse(
        R"([{"extensions": {"KHR_materials_pbrSpecularGlossiness":
             {"diffuseFactor": [0.5, 0.5, 0.5, 1], "diffuseTexture": {"index": 0}}}}])");
    expect_mutants_survived("m.gltf", document.text());
}

TEST(Mutations, OfBinaryStl) {
    std::string bytes(80, ' ');
    bytes += bytes_of<std::uint32_t>({2});
    for (int k = 0; k < 2; ++k)
        bytes += bytes_of<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(2, '\0');
    expect_mutants_survived("m.stl", bytes);
}

TEST(Mutations, OfStl) {
    expect_mutants_survived("m.stl",
                            "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\nendsolid x\nsolid\ncolor 1 0 0\n"
                            "FACET\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\nVERTEX 0 1 0\n"
                            "VERTEX 0 0.5 0\nEND LOOP\nEND FACET\nEND SOLID\n");
}

}  // namespace
}  // namespace patchlight::server::mutations_test
