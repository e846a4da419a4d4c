#include "server/files/glb_chunks.h"

#include "solver/scene/input_error.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace patchlight::server {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian");

constexpr std::size_t file_header_bytes = 12;  // magic, version, length
constexpr std::size_t chunk_header_bytes = 8;  // length, type
constexpr std::uint32_t json_type = 0x4E4F534A;
constexpr std::uint32_t binary_type = 0x004E4942;

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.starts_with("glTF"); }

GlbChunks split_glb(std::string_view bytes, const std::string& file) {
    if (bytes.size() < file_header_bytes) throw InputError(file, "ends within its header");
    if (const std::uint32_t version = word_at(bytes, 4); version != 2)
        throw InputError(file, "is GLB version " + std::to_string(version) + "; version 2 is read");
    if (const std::uint32_t length = word_at(bytes, 8); length > bytes.size())
        throw InputError(file, "has " + std::to_string(bytes.size()) + " of the " +
                                   std::to_string(length) + " bytes its header announces");
    bytes = bytes.substr(0, word_at(bytes, 8));
    GlbChunks chunks;
    for (std::size_t at = file_header_bytes; at + chunk_header_bytes <= bytes.size();) {
        const std::size_t length = word_at(bytes, at);
        const std::uint32_t type = word_at(bytes, at + 4);
        at += chunk_header_bytes;
        if (length > bytes.size() - at)
            throw InputError(file, "a chunk of " + std::to_string(length) +
                                       " bytes goes beyond the end of the file");
        if (type == json_type && chunks.json.empty()) chunks.json = bytes.substr(at, length);
        if (type == binary_type && !chunks.binary) chunks.binary = bytes.substr(at, length);
        at += length;
    }
    if (chunks.json.empty()) throw InputError(file, "has no JSON chunk");
    return chunks;
}

}  // namespace patchlight::server
