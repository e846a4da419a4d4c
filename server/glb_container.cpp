#include "server/glb_container.h"

#include <array>
#include <limits>
#include <stdexcept>

namespace patchlight::server {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t magic = 0x46546C67;         // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t binary_chunk = 0x004E4942;  // "BIN\0"
constexpr std::size_t head_size = 12;
constexpr std::size_t chunk_head_size = 8;

std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

void append_word(std::string& bytes, std::size_t number) {
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(number >> shift & 0xff);
}

void append_chunk(std::string& bytes, std::uint32_t kind, const std::string& content, char filler) {
    append_word(bytes, padded(content.size()));
    append_word(bytes, kind);
    bytes += content;
    bytes.append(padded(content.size()) - content.size(), filler);
}

}  // namespace

std::size_t GlbContainer::add_view(std::string_view bytes, std::size_t stride, Target target) {
    buffer_.resize(padded(buffer_.size()), '\0');
    Json view{{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (target == Target::vertices) view["byteStride"] = stride;
    view["target"] = static_cast<int>(target);
    buffer_ += bytes;
    document["bufferViews"].push_back(std::move(view));
    return document["bufferViews"].size() - 1;
}

std::size_t GlbContainer::add_accessor(std::size_t view, std::size_t offset, Component component,
                                       std::size_t count, const char* type) {
    Json accessor{{"bufferView", view},
                  {"byteOffset", offset},
                  {"componentType", static_cast<int>(component)},
                  {"count", count},
                  {"type", type}};
    if (component == Component::unit_u16) accessor["normalized"] = true;
    document["accessors"].push_back(std::move(accessor));
    return document["accessors"].size() - 1;
}

std::string GlbContainer::packed() {
    buffer_.resize(padded(buffer_.size()), '\0');
    if (!buffer_.empty()) document["buffers"] = Json::array({Json{{"byteLength", buffer_.size()}}});
    const std::string text = document.dump();
    const std::size_t chunks = buffer_.empty() ? 1 : 2;
    const std::size_t size =
        head_size + chunks * chunk_head_size + padded(text.size()) + buffer_.size();
    if (size > std::numeric_limits<std::uint32_t>::max())
        throw std::length_error("the mesh takes " + std::to_string(size) +
                                " bytes; a .glb cannot hold more than 4 GiB");
    std::string bytes;
    bytes.reserve(size);
    append_word(bytes, magic);
    append_word(bytes, 2);  // version
    append_word(bytes, size);
    append_chunk(bytes, json_chunk, text, ' ');
    if (!buffer_.empty()) append_chunk(bytes, binary_chunk, buffer_, '\0');
    return bytes;
}

}  // namespace patchlight::server
