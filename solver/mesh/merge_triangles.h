#pragma once

#include "solver/mesh/triangulation.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

struct MergedFaces {
    std::vector<std::array<std::uint32_t, 4>> faces;  // a triangle repeats its last vertex
};

/// Pairs triangles into convex quads, the most rectangular first; fixed edges stay.
MergedFaces merge_triangles(const Triangulation& triangulation);

}  // namespace patchlight
