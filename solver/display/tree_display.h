#pragma once

#include "solver/display/refinement_tree.h"
#include "solver/solution.h"

#include <vector>

namespace patchlight {

/// Irradiance in two parts [W/m²].
struct SplitIrradiance {
    std::vector<Rgb> direct, indirect;
};

/// The leaves of a balanced tree as triangles that leave no cracks.
struct TreeDisplay {
    DisplayMesh display;
    SplitIrradiance arriving;  // at each vertex of the display
    /// Triangles of element e of the tree are [first_triangle[e], first_triangle[e + 1]).
    std::vector<std::uint32_t> first_triangle = {};
};

/// `arriving` at each vertex of the tree. A vertex is made once for each object and material.
TreeDisplay make_tree_display(const Scene& scene, const PatchMesh& mesh, const RefinementTree& tree,
                              const SplitIrradiance& arriving);

/// Means over each patch; 0 where it is covered.
SplitIrradiance patch_means(const TreeDisplay& shown, std::size_t patches);

}  // namespace patchlight
