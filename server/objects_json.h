#pragma once

#include "server/json_value.h"
#include "solver/scene/scene.h"

namespace patchlight::server {

/// The block `objects` of a scene: fills `scene.objects` with those that carry geometry, named by
/// their paths, and `scene.surfaces`. `scene.materials` must be there. `metres` is the length of
/// one unit of the scene [m].
void read_objects(const JsonValue& list, double metres, Scene& scene);

}  // namespace patchlight::server
