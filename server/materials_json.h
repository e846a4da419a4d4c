#pragma once

#include "server/input_errors.h"
#include "server/json_value.h"
#include "solver/scene/scene.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patchlight::server {

/// The block `materials` of a scene, in the order of their names. What is wrong with a material
/// goes to `faults`; it is in the list all the same, so that what refers to it finds it.
std::vector<Material> read_materials(const JsonValue& block, FaultList& faults);

/// The material a scene refers to by name, of those read_materials has returned. Throws InputError
/// if there is none of that name.
MaterialIndex find_material(std::span<const Material> materials, const JsonValue& name);

/// The same, for names from elsewhere: empty if there is none.
std::optional<MaterialIndex> find_material(std::span<const Material> materials,
                                           const std::string& name);

}  // namespace patchlight::server
