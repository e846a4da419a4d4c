#pragma once

#include "solver/scene/polygon.h"
#include "solver/scene/scene.h"

#include <functional>
#include <vector>

namespace patchlight {

/// Which surfaces lie in one another's plane, within their local tolerance, and overlap.
struct CoplanarOverlaps {
    std::vector<std::vector<SurfaceIndex>> covered_by;  // same facing, listed later: hides this one
    std::vector<std::vector<SurfaceIndex>> partners;    // every overlap, either facing, ascending

    bool any(SurfaceIndex s) const { return !partners[s].empty(); }
};

/// `go_on` is asked now and then; after a false not all pairs are there.
CoplanarOverlaps find_coplanar_overlaps(const Scene& scene,
                                        const std::function<bool()>& go_on = {});

/// Clips a convex polygon to the left of the line a -> b (Sutherland & Hodgman, 1974).
std::vector<Vec2> clip_left(const std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b);

}  // namespace patchlight
