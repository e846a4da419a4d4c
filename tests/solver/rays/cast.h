#pragma once

#include "tests/solver/scenes.h"

namespace patchlight {

struct Hit {
    Landing landing = Landing::escaped;
    SurfaceIndex surface = 0;
    RayPoint at = RayPoint::Zero();  // [ray space]
};

/// Casts single rays given in the scene's own lengths.
struct Caster {
    explicit Caster(const Scene& scene) : rays(scene, find_coplanar_overlaps(scene)) {}

    Hit land(const Vec3& origin, const Vec3& direction) const;
    bool blocked(const Vec3& from, const Vec3& to) const;

    RayScene rays;
};

}  // namespace patchlight
