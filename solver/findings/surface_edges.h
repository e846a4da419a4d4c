#pragma once

#include "solver/scene/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// An edge of one surface, or one that several share whole.
struct SurfaceEdge {
    std::array<std::uint32_t, 2> ends{};     // vertices, the lower number first
    std::array<SurfaceIndex, 2> surfaces{};  // the first two that have it
    std::uint32_t uses = 1;                  // surfaces that have it

    bool is_free() const { return uses == 1; }
};

/// The edges of a scene: corners within the contact distance of each other are one vertex. Back
/// halves of two-sided polygons are left out.
struct SurfaceEdges {
    std::vector<Vec3> vertices;      // [m]
    std::vector<SurfaceEdge> edges;  // by their ends, ascending

    double length(const SurfaceEdge& edge) const {
        return (vertices[edge.ends[1]] - vertices[edge.ends[0]]).norm();
    }
    Vec3 at(const SurfaceEdge& edge, double t) const {
        return (1.0 - t) * vertices[edge.ends[0]] + t * vertices[edge.ends[1]];
    }
};

SurfaceEdges find_surface_edges(const Scene& scene);

}  // namespace patchlight
