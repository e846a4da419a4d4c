#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace patchlight::server {

/// The two parts of a binary glTF file (GLB, version 2).
struct GlbChunks {
    std::string_view json;
    std::optional<std::string_view> binary;
};

/// Whether the bytes begin as a GLB file does.
bool is_glb(std::string_view bytes);

/// Throws InputError at `file` if the chunks do not lie within the bytes.
GlbChunks split_glb(std::string_view bytes, const std::string& file);

}  // namespace patchlight::server
