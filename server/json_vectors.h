#pragma once

#include "server/json_value.h"
#include "solver/scene/light.h"

#include <Eigen/Geometry>

namespace patchlight::server {

/// [x, y, z], each within ±`limit`.
Vec3 read_vec3(const JsonValue& value, double limit);

/// A point given in an object's own coordinates, in those of the scene [m]. Throws InputError
/// unless it lies within 1e9 m of the origin: further out, rays lose their way.
Vec3 read_point(const JsonValue& value, const Eigen::Affine3d& to_scene);

/// A direction of any length but 0, made a unit vector [1].
Vec3 read_direction(const JsonValue& value);

/// [r, g, b], or one number x that means [x, x, x].
Rgb read_channels(const JsonValue& value, const Range& range);

}  // namespace patchlight::server
