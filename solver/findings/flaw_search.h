#pragma once

#include "solver/rays/ray_scene.h"
#include "solver/scene/coplanar.h"
#include "solver/scene/scene.h"

#include <cstdint>
#include <functional>

namespace patchlight {

/// What is searched for flaws. The scene has surfaces.
struct FlawSearch {
    const Scene& scene;
    const CoplanarOverlaps& overlaps;
    const RayScene& rays;
    std::uint64_t seed = 1;
    /// Asked now and then: after a false the search ends, with the flaws it has come upon.
    std::function<bool()> go_on = {};

    LocalTolerance tolerance{scene};
    bool stopped() const { return go_on && !go_on(); }
    /// Of what surrounds surface s: its frame [m].
    double size(SurfaceIndex s) const { return tolerance.frame(s).size(); }
    double size_at(const Vec3& p) const { return tolerance.frames()[tolerance.frame_at(p)].size(); }
    /// What an edge of surface s may be off and still touch [m].
    double contact(SurfaceIndex s) const { return tolerance.at_point(tolerance.frame_of(s)); }
    const std::string& object_of(SurfaceIndex s) const {
        return scene.objects[scene.surfaces[s].object].name;
    }
};

}  // namespace patchlight
