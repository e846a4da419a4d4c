#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/solution.h"

#include <vector>

namespace patchlight {

/// Radiosity at the vertices of smooth surfaces from that of patches: each patch is given the slope
/// that fits its neighbours best (least squares), less where they do not lie on one slope, as
/// across a shadow's edge; and a vertex takes the mean of what the patches round it say there, kept
/// within the range of their neighbourhood, widened by as much again on either side, and above 0.
/// Linear fields are met exactly up to the edges of a surface. Nothing is averaged over creases,
/// materials or objects. `hidden[i]`: the share of patch i that sees nothing but backs (under a box
/// without a bottom); such patches do not darken their neighbours.
DisplayMesh make_display(const Scene& scene, const PatchMesh& mesh,
                         const std::vector<Rgb>& radiosity, const std::vector<double>& hidden);

}  // namespace patchlight
