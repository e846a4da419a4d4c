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
    std::vector<Vec2> points;                         // [m]
    std::vector<std::array<std::uint32_t, 4>> faces;  // counter-clockwise
};

struct PolygonOutline {
    std::vector<Vec2> corners;                 // counter-clockwise [m]
    std::vector<std::vector<Vec2>> divisions;  // per edge: points strictly between its ends [m]
};

/// Meshes a simple polygon of any shape: square cells along its main direction where they fit,
/// triangles towards the edges; no edge longer than `longest`, no vertex added on the boundary.
/// `creases`: polygons whose outlines become edges of the mesh where they cross this polygon.
PolygonMesh mesh_polygon(const PolygonOutline& outline, std::span<const std::vector<Vec2>> creases,
                         double longest);

}  // namespace patchlight
