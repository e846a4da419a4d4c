#pragma once

#include "solver/findings/viewpoint.h"
#include "solver/rays/ray_scene.h"
#include "solver/scene/coplanar.h"
#include "solver/scene/scene.h"
#include "solver/settings.h"

#include <functional>
#include <span>
#include <vector>

namespace patchlight {

struct Flaws {
    std::vector<Finding> findings;
    std::vector<bool> misplaced;  // as in scene.sensors
};

/// What the author of the scene should know, before anything is solved. `planned`: with every
/// choice made. The scene has surfaces. `go_on` is asked before each search, and now and then
/// within; after a false the others are left out.
Flaws find_flaws(const Scene& scene, const CoplanarOverlaps& overlaps, const RayScene& rays,
                 const SolveSettings& planned, std::span<const Viewpoint> viewpoints,
                 const std::function<bool()>& go_on = {});

/// The same of its geometry alone: what surfaces reflect and how it is solved does not matter to
/// form factors.
std::vector<Finding> find_geometry_flaws(const Scene& scene, const CoplanarOverlaps& overlaps,
                                         const RayScene& rays, std::uint64_t seed,
                                         const std::function<bool()>& go_on = {});

}  // namespace patchlight
