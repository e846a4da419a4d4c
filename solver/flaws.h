#pragma once

#include "solver/scene/coplanar.h"
#include "solver/scene/scene.h"

#include <vector>

namespace patchlight {

/// What the author of the scene should know, before anything is solved.
std::vector<Finding> find_flaws(const Scene& scene, const CoplanarOverlaps& overlaps);

/// The same of its geometry alone: whether there is any light does not matter to form factors.
std::vector<Finding> find_geometry_flaws(const Scene& scene, const CoplanarOverlaps& overlaps);

}  // namespace patchlight
