#pragma once

#include "server/files/imported_geometry.h"

#include <filesystem>
#include <string>

namespace patchlight::server {

/// An STL file, text or binary: triangles without materials. The order of their corners says where
/// the front is; the normals the file gives are left out. `file` is how messages call it. Throws
/// InputError at "file:line" or "file".
ImportedGeometry read_stl(const std::filesystem::path& path, const std::string& file);

}  // namespace patchlight::server
