#pragma once

#include "server/json_value.h"

#include <Eigen/Geometry>

namespace patchlight::server {

/// From an object's own coordinates to its parent's, as in glTF: `matrix` (16 numbers,
/// column-major, affine), or translation * rotation * scale. The identity if it has neither.
/// Throws InputError if it would flatten the object.
Eigen::Affine3d read_transform(const JsonValue& object);

}  // namespace patchlight::server
