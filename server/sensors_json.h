#pragma once

#include "server/json_value.h"
#include "solver/scene/scene.h"

namespace patchlight::server {

/// The block `sensors` of a scene: points, and grids of points at cell centres. `metres` is the
/// length of one unit of the scene [m].
void read_sensors(const JsonValue& list, double metres, Scene& scene);

}  // namespace patchlight::server
