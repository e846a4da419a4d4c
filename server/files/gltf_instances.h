#pragma once

#include "server/files/gltf_accessors.h"

#include <Eigen/Geometry>

#include <optional>
#include <vector>

namespace patchlight::server {

/// Where a node places its mesh, in its own coordinates (EXT_mesh_gpu_instancing); empty if it does
/// so once, as most do. Throws InputError.
std::optional<std::vector<Eigen::Affine3d>> read_gltf_instances(const JsonValue& node,
                                                                GltfAccessors& accessors);

}  // namespace patchlight::server
