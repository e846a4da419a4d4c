#pragma once

#include "solver/findings/flaw_search.h"
#include "solver/findings/surface_tree.h"

#include <vector>

namespace patchlight {

/// Surfaces that hang together: each touches another of its assembly, to within the contact
/// distance, or passes through it, or is a flat object along another surface, nearer than a
/// hundredth of its size: posters and rugs are put a little off a wall or floor on purpose. A table
/// is an assembly, and so is a room with all that stands in it.
struct Assemblies {
    std::vector<std::uint32_t> of_surface;
    std::vector<std::vector<SurfaceIndex>> members;  // ascending; without back halves
};
Assemblies find_assemblies(const FlawSearch& search, const SurfaceTree& tree);

/// Whether two surfaces come within `reach` of each other: a corner of one at the other, or an edge
/// of one through the other.
bool touch(const Surface& a, const Surface& b, double reach);

}  // namespace patchlight
