#pragma once

#include "server/files/imported_geometry.h"

#include <filesystem>
#include <string>

namespace patchlight::server {

/// A Wavefront OBJ file with the MTL files it names. Polygons stay polygons; `o` and `g` make parts
/// with the path "object/group"; normals, texture coordinates, lines and points are left out.
/// `file` is how messages call it. Throws InputError at "file:line".
ImportedGeometry read_obj(const std::filesystem::path& path, const std::string& file);

}  // namespace patchlight::server
