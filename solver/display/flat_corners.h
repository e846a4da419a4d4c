#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/plane_groups.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// Corners of patches at which irradiance is one value: those round a vertex in one plane, joined
/// over edges that are no creases: nothing stands on them, and no other plane ends there, which may
/// be a wall between two rooms; but the other side of a two-sided polygon is none. Materials do not
/// matter: paint does not change what arrives.
struct FlatCorners {
    std::size_t count = 0;
    std::vector<std::array<std::uint32_t, 4>> of_patch;  // number at each vertex of each patch
    std::vector<std::uint8_t> creases;  // of each patch; bit k: the edge from vertex k on
};

/// Covered patches take no part.
FlatCorners find_flat_corners(const PatchMesh& mesh, const PlaneGroups& planes);

}  // namespace patchlight
