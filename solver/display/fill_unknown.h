#pragma once

#include "solver/display/refinement_tree.h"
#include "solver/scene/scene.h"

#include <vector>

namespace patchlight {

/// A field at corners of roots that are not `known`, for the work was stopped before they were
/// gathered: the mean over those that are, within a few hundredths of the scene, and face alike;
/// where there are none, the `guess` for their patch, or without guesses the mean over a larger
/// part of the scene.
void fill_unknown(const Scene& scene, const PatchMesh& mesh, const RefinementTree& tree,
                  const std::vector<bool>& known, const std::vector<Rgb>& guess,
                  std::vector<Rgb>& values);

}  // namespace patchlight
