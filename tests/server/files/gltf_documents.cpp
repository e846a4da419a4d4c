#include "tests/server/files/gltf_documents.h"

#include "tests/server/files/written_files.h"

namespace patchlight::server {
namespace {

std::string chunk(const std::string& type, std::string bytes, char filling) {
    bytes.resize((bytes.size() + 3) / 4 * 4, filling);
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(bytes.size())}) + type + bytes;
}

}  // namespace

std::string base64_of(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        const auto at = [&](std::size_t i) {
            return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u;
        };
        const unsigned bits = at(k) << 16 | at(k + 1) << 8 | at(k + 2);
        for (int shift = 18; shift >= 0; shift -= 6) text += digits[bits >> shift & 63];
        if (k + 1 >= bytes.size())
            text.replace(text.size() - 2, 2, "==");
        else if (k + 2 >= bytes.size())
            text.back() = '=';
    }
    return text;
}

GltfDocument::GltfDocument()
    : json{{"asset", {{"version", "2.0"}}},
           {"scene", 0},
           {"scenes", {{{"nodes", nlohmann::json::array()}}}}} {}

std::size_t GltfDocument::accessor(std::string_view bytes, int component_type, std::size_t count,
                                   const std::string& type) {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}});
    buffer_ += bytes;
    json["accessors"].push_back({{"bufferView", json["bufferViews"].size() - 1},
                                 {"componentType", component_type},
                                 {"count", count},
                                 {"type", type}});
    return json["accessors"].size() - 1;
}

std::size_t GltfDocument::node(const nlohmann::json& primitive, const nlohmann::json& more) {
    json["meshes"].push_back({{"primitives", {primitive}}});
    nlohmann::json node{{"mesh", json["meshes"].size() - 1}};
    if (!more.is_null()) node.update(more);
    json["nodes"].push_back(node);
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
    return json["nodes"].size() - 1;
}

std::size_t GltfDocument::square() {
    return accessor(bytes_of<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}), 5126, 4, "VEC3");
}

std::string GltfDocument::text() const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", buffer_.size()},
                         {"uri", "data:application/octet-stream;base64," + base64_of(buffer_)}}};
    return whole.dump();
}

std::string GltfDocument::glb() const {
    nlohmann::json whole = json;
    whole["buffers"] = {{{"byteLength", buffer_.size()}}};
    const std::string chunks =
        chunk("JSON", whole.dump(), ' ') + chunk(std::string("BIN\0", 4), buffer_, '\0');
    return "glTF" + bytes_of<std::uint32_t>({2, static_cast<std::uint32_t>(12 + chunks.size())}) +
           chunks;
}

}  // namespace patchlight::server
