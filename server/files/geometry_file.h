#pragma once

#include "server/files/imported_geometry.h"

#include <filesystem>
#include <string>

namespace patchlight::server {

/// Whether the name of a file ends as that of a geometry file does: .obj, .gltf, .glb or .stl, in
/// small letters or capitals.
bool is_geometry_file(const std::filesystem::path& path);

/// Reads such a file. `file` is how messages call it. Throws InputError at "file:line" or "file".
ImportedGeometry read_geometry_file(const std::filesystem::path& path, const std::string& file);

}  // namespace patchlight::server
