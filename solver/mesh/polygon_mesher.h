#pragma once

#include "solver/scene/polygon.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

/// Quads and triangles (last vertex repeated) over one polygon. The first points are those of the
/// boundary, as given; the others lie inside.
struct PolygonMesh {
    std::vector<Vec2> points;                                // [m]
    std::vector<std::array<std::uint32_t, 4>> faces;         // counter-clockwise
    std::vector<std::array<std::uint32_t, 2>> crease_edges;  // edges that lie on creases
};

struct FlatSegment {
    Vec2 a, b;  // [m]
};

struct PolygonOutline {
    std::vector<Vec2> corners;                 // counter-clockwise [m]
    std::vector<std::vector<Vec2>> divisions;  // per edge: points strictly between its ends [m]
};

/// Meshes a simple polygon of any shape: square cells along its main direction where they fit,
/// triangles towards the edges; no edge longer than `longest`. Vertices are added on the boundary
/// only where a crease meets it. `creases`: lines that become edges of the mesh as far as they lie
/// inside the polygon.
PolygonMesh mesh_polygon(const PolygonOutline& outline, std::span<const FlatSegment> creases,
                         double longest);

}  // namespace patchlight
