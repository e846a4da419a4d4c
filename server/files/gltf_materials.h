#pragma once

#include "server/files/gltf_pictures.h"
#include "server/files/imported_geometry.h"
#include "server/json_value.h"

#include <vector>

namespace patchlight::server {

/// The materials of a glTF document, and last a nameless one for primitives without any.
/// baseColorFactor is the reflectance, or diffuseFactor of KHR_materials_pbrSpecularGlossiness,
/// also of metals: all that they reflect is taken as diffuse, so that no light is lost. One that is
/// not given says nothing (the format would have it white). emissiveFactor times
/// KHR_materials_emissive_strength is the radiance; doubleSided is two-sided.
std::vector<FileMaterial> read_gltf_materials(const JsonValue& root, GltfPictures& pictures);

}  // namespace patchlight::server
