#pragma once

#include "solver/scene/coplanar.h"
#include "solver/scene/scene.h"

#include <functional>
#include <vector>

namespace patchlight {

/// Of each surface the area that no coplanar polygon listed later covers: what is there for light;
/// 0 exactly where all of it is covered [m²].
/// `go_on` is asked now and then; after a false the others count as seen.
std::vector<double> seen_areas(const Scene& scene, const CoplanarOverlaps& overlaps,
                               const std::function<bool()>& go_on = {});

}  // namespace patchlight
