#include "tests/server/files/gltf_documents.h"
#include "tests/server/files/written_files.h"
#include "tests/server/run_program.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace patchlight::server::gltf_rejects_test {
namespace {

using Json = nlohmann::json;

GltfDocument square() {
    GltfDocument document;
    const std::size_t positions = document.square();
    const std::size_t indices =
        document.accessor(bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3}), 5123, 6, "SCALAR");
    document.node({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
    return document;
}

/// A square with `member`, a JSON pointer, replaced by `value`.
void expect_rejected_with(const std::string& member, const Json& value, const std::string& words) {
    GltfDocument document = square();
    document.json[Json::json_pointer(member)] = value;
    expect_file_rejected("bad.gltf", document.text(), words);
}

void expect_buffer_rejected(const Json& buffer, const std::string& words) {
    GltfDocument document = square();
    document.json["buffers"] = {buffer};
    expect_file_rejected("bad.gltf", document.json.dump(), words);
}

TEST(GltfRejects, WhatIsNoGltf2) {
    expect_file_rejected("bad.gltf", "", "bad.gltf: the document is empty");
    expect_file_rejected("bad.gltf", "{\n\"asset\": ", "bad.gltf:2:");
    expect_file_rejected("bad.gltf", "[]", "must be an object");
    expect_file_rejected("bad.gltf", "{}", "needs 'asset'");
    expect_file_rejected("bad.gltf", R"({"asset": {"version": "2.0"}})", "no triangles");
    expect_file_rejected("bad.gltf", R"({"asset": {"version": "2.0"}, "asset": 7})", "given twice");
    expect_rejected_with("/asset/version", "1.0", "/asset/version: is glTF '1.0'");
    expect_file_rejected("bad.gltf",
                         R"({"asset": {"version": "2.0"}, "extras": )" + std::string(100'000, '['),
                         "nested deeper");
}

TEST(GltfRejects, RequiredExtensionsByName) {
    expect_rejected_with("/extensionsRequired", {"KHR_draco_mesh_compression"},
                         "/extensionsRequired/0: the file requires the extension "
                         "'KHR_draco_mesh_compression'");
}

TEST(GltfRejects, BinaryFilesThatAreNotWhole) {
    const std::string whole = square().glb();
    for (const std::size_t length : {3u, 8u, 15u, 25u, 100u})
        expect_file_rejected("bad.glb", whole.substr(0, length), "");
    expect_file_rejected("bad.glb", whole.substr(0, whole.size() - 1),
                         "bytes its header announces");
    std::string bytes = whole;
    bytes[0] = 'G';
    expect_file_rejected("bad.glb", bytes, "does not begin with 'glTF'");
    bytes = whole;
    bytes[4] = 1;
    expect_file_rejected("bad.glb", bytes, "is GLB version 1");
    bytes = whole;
    bytes.replace(12, 4, "\xFF\xFF\xFF\xFF");
    expect_file_rejected("bad.glb", bytes, "a chunk of 4294967295 bytes");
    bytes = whole;
    bytes.replace(16, 4, "NOSJ");
    expect_file_rejected("bad.glb", bytes, "has no JSON chunk");
}

TEST(GltfRejects, BuffersThatAreNotThere) {
    const Json length{{"byteLength", 60}};
    const auto with_uri = [&](const std::string& uri) {
        Json buffer = length;
        buffer["uri"] = uri;
        return buffer;
    };
    expect_buffer_rejected(length, "/buffers/0: needs 'uri'");
    expect_buffer_rejected(with_uri("none.bin"),
                           "/buffers/0/uri: 'none.bin' cannot be read: No such");
    expect_buffer_rejected(with_uri("../x.bin"), "does not lie beside");
    expect_buffer_rejected(with_uri("a/../../x.bin"), "does not lie beside");
    expect_buffer_rejected(with_uri("/etc/passwd"), "does not lie beside");
    expect_buffer_rejected(with_uri("http://example.org/x.bin"), "does not lie beside");
    expect_buffer_rejected(with_uri("%2e%2e/x.bin"), "does not lie beside");
    expect_buffer_rejected(with_uri("."), "is a directory");
    expect_buffer_rejected(with_uri("data:application/octet-stream,AAAA"), "in base64");
    expect_buffer_rejected(with_uri("data:;base64,AAAA!!!!"), "is no base64");
    expect_buffer_rejected(with_uri("data:;base64,AAAAA"), "is no base64");
    expect_buffer_rejected(with_uri("data:;base64,AAAA"), "announces 60 bytes; there are 3");
    expect_buffer_rejected({{"byteLength", 1e15}, {"uri", "x"}},
                           "/buffers/0/byteLength: must be from");
    expect_buffer_rejected({{"uri", "x"}}, "needs 'byteLength'");
}

TEST(GltfRejects, RangesBeyondTheirBytes) {
    expect_rejected_with("/accessors/0/count", 5, "/accessors/0: its 5 elements end at byte 60");
    expect_rejected_with("/accessors/0/count", 4e9, "/accessors/0/count: must be from 1");
    expect_rejected_with("/accessors/0/count", 0, "must be from 1");
    expect_rejected_with("/accessors/0/count", -1, "must be from 1");
    expect_rejected_with("/accessors/0/byteOffset", 4, "end at byte 52 of a buffer view of 48");
    expect_rejected_with("/accessors/0/byteOffset", 1e12, "end at byte");
    expect_rejected_with("/accessors/0/byteOffset", 1e18, "/accessors/0/byteOffset: must be");
    expect_rejected_with("/accessors/0/byteOffset", -4, "must be from 0");
    expect_rejected_with("/bufferViews/0/byteLength", 1000,
                         "/bufferViews/0: ends at byte 1000 of a buffer of 60");
    expect_rejected_with("/bufferViews/0/byteOffset", 1e12, "ends at byte");
    expect_rejected_with("/bufferViews/0/byteStride", 252, "end at byte 768");
    expect_rejected_with("/bufferViews/0/byteStride", 0, "must be from 1");
    expect_rejected_with("/bufferViews/0/buffer", 1,
                         "there is no element 1 in 'buffers'; it has 1");
    expect_rejected_with("/accessors/0/bufferView", 99, "there is no element 99 in 'bufferViews'");
    expect_rejected_with("/accessors/0/bufferView", -1, "there is no element -1");
    expect_rejected_with("/accessors/0/bufferView", "x", "must be a number");
}

TEST(GltfRejects, AccessorsOfTheWrongKind) {
    expect_rejected_with("/accessors/0/type", "VEC2", "must be 'VEC3' here, not 'VEC2'");
    expect_rejected_with("/accessors/1/type", "VEC3", "must be 'SCALAR' here");
    expect_rejected_with("/accessors/1/componentType", 5126, "indices must be 5121, 5123 or 5125");
    expect_rejected_with("/accessors/0/componentType", 5124, "not 5124");
    expect_rejected_with("/accessors/0/componentType", 1, "must be from 5120");
    expect_rejected_with("/accessors/0", 7, "needs 'type'");
}

TEST(GltfRejects, SparsePartsOutOfRange) {
    const auto sparse = [](int count, int view, const std::string& which) {
        Json block{{"count", count},
                   {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                   {"values", {{"bufferView", 0}}}};
        block[which]["bufferView"] = view;
        return block;
    };
    expect_rejected_with("/accessors/0/sparse", sparse(5, 1, "indices"), "must be from 1 to 4");
    expect_rejected_with("/accessors/0/sparse", sparse(1, 9, "indices"), "there is no element 9");
    expect_rejected_with("/accessors/0/sparse", sparse(2, 1, "values"),
                         "end at byte 24 of a buffer view of 12");
    GltfDocument document = square();
    const std::size_t places = document.accessor(bytes_of<std::uint32_t>({4}), 5125, 1, "SCALAR");
    document.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", places}, {"componentType", 5125}}},
        {"values", {{"bufferView", 0}}}};
    expect_file_rejected("bad.gltf", document.text(),
                         "element 4 does not exist; the accessor has 4");
}

TEST(GltfRejects, NumbersThatAreNotFinite) {
    for (const float wrong :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
        GltfDocument document;
        const std::size_t positions =
            document.accessor(bytes_of<float>({0, 0, 0, 1, 0, wrong, 1, 1, 0}), 5126, 3, "VEC3");
        document.node({{"attributes", {{"POSITION", positions}}}});
        expect_file_rejected("bad.gltf", document.text(), wrong == 1e30f ? "±1e+15" : "not finite");
    }
}

TEST(GltfRejects, PrimitivesThatDoNotAddUp) {
    const std::string primitive = "/meshes/0/primitives/0";
    expect_rejected_with("/accessors/0/count", 3,
                         primitive + "/indices: vertex 3 does not exist; there are 3");
    expect_rejected_with("/accessors/1/count", 5,
                         primitive + ": has 5 corners; triangles take three");
    expect_rejected_with(primitive + "/mode", 7, "must be from 0 to 6");
    expect_rejected_with(primitive + "/attributes", Json::object(), "needs 'POSITION'");
    expect_rejected_with(primitive + "/attributes/POSITION", 9,
                         "there is no element 9 in 'accessors'");
    expect_rejected_with(primitive + "/indices", 9, "there is no element 9 in 'accessors'");
    expect_rejected_with(primitive + "/material", 0,
                         "there is no element 0 in 'materials'; it has 0");
    expect_rejected_with("/meshes/0", Json::object(), "needs 'primitives'");
    expect_rejected_with("/meshes", Json::object(), "must be an array");
}

TEST(GltfRejects, NodesThatFormNoTree) {
    expect_rejected_with("/nodes/0/children", {0}, "/nodes/0/children/0: node 0 is met twice");
    expect_rejected_with("/nodes/0/children", {9}, "there is no element 9 in 'nodes'");
    expect_rejected_with("/nodes/0/mesh", 3, "there is no element 3 in 'meshes'");
    expect_rejected_with("/scenes/0/nodes", {0, 0}, "node 0 is met twice");
    expect_rejected_with("/scene", 1, "there is no element 1 in 'scenes'");
    expect_rejected_with("/nodes/0/scale", {1, 0, 1}, "must not be 0");
    expect_rejected_with("/nodes", 5, "must be an array");
    GltfDocument deep = square();
    for (int k = 0; k < 300; ++k) deep.json["nodes"].push_back({{"children", {k}}});
    deep.json["scenes"][0]["nodes"] = {300};
    expect_file_rejected("bad.gltf", deep.text(), "more than 200 deep");
}

TEST(GltfRejects, MaterialsThatCannotBe) {
    const auto with = [](const std::string& text) { return Json::array({Json::parse(text)}); };
    expect_rejected_with("/materials", with(R"({"emissiveFactor": [0, -1, 0]})"),
                         "/materials/0/emissiveFactor/1: must be at least 0");
    expect_rejected_with("/materials", with(R"({"emissiveFactor": [1, 1]})"), "3 or 4 numbers");
    expect_rejected_with("/materials",
                         with(R"({"pbrMetallicRoughness": {"baseColorFactor": [1e30, 0, 0, 1]}})"),
                         "at most 1e+15");
}

TEST(GltfRejects, AccessorsThatAskForMemoryOutOfNothing) {
    GltfDocument document = square();
    document.json["accessors"][0].erase("bufferView");  // all zero
    document.json["accessors"][0]["count"] = 12'000'001;
    expect_file_rejected("bad.gltf", document.text(), "must be from 1 to 12000000");
}

}  // namespace
}  // namespace patchlight::server::gltf_rejects_test
