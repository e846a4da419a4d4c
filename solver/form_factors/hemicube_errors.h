#pragma once

#include "solver/form_factors/hemicube_engine.h"
#include "solver/solution.h"

#include <functional>
#include <optional>

namespace patchlight {

/// Takes the error of hemicubes apart on a sample of patches. Aliasing: two hemicubes turned
/// otherwise, half the mean square of their difference. Proximity: exact factors of the parts'
/// centres against exact factors of the whole patch, nothing between, as far as the target is seen.
/// Visibility: what is left of the distance to analytic factors with visibility by rays, of those
/// patches that something hides; 0 where nothing is in the way. Nothing if `in_time` ends it.
std::optional<HemicubeErrors> estimate_hemicube_errors(const Scene& scene, const PatchMesh& mesh,
                                                       const RayScene& ray_scene,
                                                       const HemicubeSettings& settings,
                                                       const std::function<bool()>& in_time = {});

}  // namespace patchlight
