#pragma once

#include "server/json_value.h"
#include "solver/scene/scene.h"

#include <vector>

namespace patchlight::server {

/// The block `materials` of a scene, in the order of their names.
std::vector<Material> read_materials(const JsonValue& block);

/// The material a scene refers to by name. Throws InputError if there is none of that name.
MaterialIndex find_material(const std::vector<Material>& materials, const JsonValue& name);

}  // namespace patchlight::server
