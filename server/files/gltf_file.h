#pragma once

#include "server/files/imported_geometry.h"

#include <filesystem>
#include <string>

namespace patchlight::server {

/// A glTF 2.0 file, text or binary (GLB): the nodes of its scene with their transforms, each mesh a
/// part with the path of its node. In metres. Textures, lights without area and skins are remarked
/// on; any other extension that the file requires is refused. `file` is how messages call it.
/// Throws InputError at "file: /JSON/pointer".
ImportedGeometry read_gltf(const std::filesystem::path& path, const std::string& file);

}  // namespace patchlight::server
