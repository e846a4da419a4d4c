#pragma once

#include "solver/scene/contact_lines.h"
#include "solver/scene/scene.h"

#include <span>
#include <vector>

namespace patchlight {

/// A point on an edge of a surface, not at its ends, that must become a vertex of the mesh.
struct EdgeStop {
    std::size_t edge = 0;       // from corner `edge` to the next
    Vec3 point = Vec3::Zero();  // [m]
};

/// A crease whose ends, where they touch the surface's outline within `reach`, lie on it exactly.
Segment snap_to_outline(const Surface& surface, const Segment& crease, double reach);

/// Where creases of a surface end on its edges or cross them.
std::vector<EdgeStop> find_edge_stops(const Surface& surface, std::span<const Segment> creases,
                                      double reach);

}  // namespace patchlight
