#pragma once

#include "solver/display/refinement_tree.h"
#include "solver/scene/scene.h"

#include <span>
#include <vector>

namespace patchlight {

/// What was gathered at the vertices of a tree, with noise.
struct NoisyField {
    std::span<const Rgb> values;       // [W/m²]
    std::span<const double> variance;  // of what is reflected of each, luminance [W²/m⁴]
    const std::vector<bool>& known;    // those that were gathered
    std::span<const Rgb> reflectance;  // of each patch [1]
};

/// The most likely field behind it. A vertex is bound to the value that is expected between its
/// parents, as closely as gathered values of its element and the ones beside it agree with what
/// they expect, beyond their noise: where the field is smooth, neighbours share their rays; where
/// it has edges, values stay as they are. `least_miss`: what interpolation may miss anyway,
/// luminance reflected [W/m²]. Minimises Σ (u - m)²/s² + Σ (u - expected(u))²/τ² by conjugate
/// gradients: the maximum a posteriori with normal errors of variances s² and τ².
std::vector<Rgb> likely_field(const RefinementTree& tree, const NoisyField& field,
                              double least_miss);

}  // namespace patchlight
