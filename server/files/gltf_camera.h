#pragma once

#include "server/files/imported_geometry.h"
#include "server/json_value.h"

#include <Eigen/Geometry>

#include <string>

namespace patchlight::server {

/// The camera that a node refers to, named by the node's path. It looks along -z of the node, with
/// +y up. Throws InputError.
FileCamera read_gltf_camera(const JsonValue& reference, const JsonValue& root,
                            const std::string& path, const Eigen::Affine3d& to_file);

}  // namespace patchlight::server
