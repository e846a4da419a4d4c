#pragma once

#include "solver/findings/cracks.h"
#include "solver/findings/surface_edges.h"
#include "solver/findings/surface_tree.h"

#include <span>
#include <vector>

namespace patchlight {

/// Where an edge comes close to a surface without touching it.
struct Gap {
    std::size_t edge = 0;         // number in SurfaceEdges
    SurfaceIndex owner = 0;       // a surface of the edge
    SurfaceIndex other = 0;       // which it nearly meets
    Vec3 middle = Vec3::Zero();   // between the two [m]
    Vec3 across = Vec3::UnitX();  // unit, from the edge to the other surface
    Vec3 along = Vec3::UnitY();   // unit, of the edge
    double width = 0.0;           // [m]
};

/// Gaps wider than 1e-6 of the size of what is around (a frame) and no wider than 1e-2 of that
/// size, nor a fifth of the edge's length: beside free edges, and beside creases of more than 30
/// degrees. Cracks at T-vertices are left out.
std::vector<Gap> find_gaps(const FlawSearch& search, const SurfaceEdges& edges,
                           const SurfaceTree& tree, std::span<const Crack> cracks);

}  // namespace patchlight
