#pragma once

#include "solver/mesh/patch_mesh.h"

#include <vector>

namespace patchlight {

/// At each vertex, the patches round it that form one smooth surface: neighbours over edges that
/// are no creases, of one object, material and side, their normals within a few degrees. Each such
/// corner is a vertex of the display mesh.
struct SmoothCorner {
    VertexIndex vertex = 0;
    std::vector<PatchIndex> patches;
};

struct SmoothGroups {
    std::vector<SmoothCorner> corners;
    std::vector<std::array<std::uint32_t, 4>> of_patch;  // corner at each of a patch's vertices
};

/// Covered patches take no part.
SmoothGroups find_smooth_groups(const Scene& scene, const PatchMesh& mesh);

}  // namespace patchlight
