#pragma once

#include "server/json_value.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace patchlight::server {

/// The element of `list`, an array at the top of a glTF document, that `reference` names by its
/// number. Throws InputError if there is none.
std::size_t gltf_index(const JsonValue& reference, const JsonValue& root, const char* list);

/// The bytes of a data URI in base64. Throws InputError.
std::string read_data_uri(const JsonValue& uri);

/// The file that a relative URI names, if it lies beside `path` or below. It need not be there.
std::optional<std::filesystem::path> file_of_uri(const JsonValue& uri,
                                                 const std::filesystem::path& path);

/// The buffers of a glTF document: data URIs, files beside `path`, and for the first of a GLB file
/// its `binary` chunk. Each has at least the bytes it announces; together they are at most 512 MiB.
std::vector<std::string> read_gltf_buffers(const JsonValue& root, const std::filesystem::path& path,
                                           std::optional<std::string_view> binary);

}  // namespace patchlight::server
