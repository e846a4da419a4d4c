#pragma once

#include "server/files/imported_geometry.h"
#include "server/json_value.h"

namespace patchlight::server {

/// Throws InputError if the document requires an extension whose part in diffuse light is not read.
void check_gltf_extensions(const JsonValue& root);

/// Remarks on what the document holds and is left out as a whole: extensions that are not read,
/// animations, other scenes.
void remark_on_gltf(const JsonValue& root, ImportedGeometry& geometry);

}  // namespace patchlight::server
