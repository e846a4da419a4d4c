#pragma once

#include "solver/rays/ray_scene.h"
#include "solver/scene/coplanar.h"
#include "solver/scene/scene.h"

#include <cstdint>

namespace patchlight {

/// What is searched for flaws. The scene has surfaces.
struct FlawSearch {
    const Scene& scene;
    const CoplanarOverlaps& overlaps;
    const RayScene& rays;
    std::uint64_t seed = 1;

    double size = scene_size(scene);  // [m]
    const std::string& object_of(SurfaceIndex s) const {
        return scene.objects[scene.surfaces[s].object].name;
    }
};

}  // namespace patchlight
