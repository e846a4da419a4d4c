#pragma once

#include "solver/scene/polygon.h"
#include "solver/scene/scene.h"

#include <vector>

namespace patchlight {

/// Which surfaces lie in one another's plane, within 1e-6 of the scene's size, and overlap.
struct CoplanarOverlaps {
    std::vector<std::vector<SurfaceIndex>> covered_by;  // same facing, listed later: hides this one
    std::vector<std::vector<SurfaceIndex>> partners;    // every overlap, either facing, ascending

    bool any(SurfaceIndex s) const { return !partners[s].empty(); }
};

CoplanarOverlaps find_coplanar_overlaps(const Scene& scene);

/// One finding for each pair of objects whose surfaces overlap facing the same way.
std::vector<Finding> overlap_findings(const Scene& scene, const CoplanarOverlaps& overlaps);

/// Clips a convex polygon to the left of the line a -> b (Sutherland & Hodgman, 1974).
std::vector<Vec2> clip_left(const std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b);

}  // namespace patchlight
