#pragma once

#include "solver/findings/flaw_search.h"
#include "solver/findings/surface_edges.h"

#include <span>
#include <vector>

namespace patchlight {

/// A free edge beside which other free edges run from end to end without lying on it: a vertex of
/// theirs is off the edge by more than the local tolerance, and less than a hundredth of its
/// length. A T-vertex that lies on the edge is none: rays and patches meet there without a gap.
struct Crack {
    std::size_t edge = 0;               // number in SurfaceEdges
    std::vector<std::size_t> others{};  // those that run beside it
    SurfaceIndex beside = 0;            // that has the vertex
    Vec3 place = Vec3::Zero();          // of the vertex farthest off [m]
    double width = 0.0;                 // its distance from the edge [m]
};
std::vector<Crack> find_cracks(const FlawSearch& search, const SurfaceEdges& edges);

/// "t-vertex": one for each pair of objects, with its widest crack.
std::vector<Finding> crack_findings(const FlawSearch& search, const SurfaceEdges& edges,
                                    std::span<const Crack> cracks);

}  // namespace patchlight
