#pragma once

#include "solver/display/refinement_tree.h"
#include "solver/scene/scene.h"

#include <span>

namespace patchlight {

/// How far the middle of an edge lies off the mean of its ends where a field bends as it does along
/// a row of vertices about the edge: the parabola through them, an eighth of the second difference.
/// Limited, so that beside a shadow's edge nothing swings: to a quarter of the step along the edge
/// and a hundredth of the values at its ends. In the unit of `values`.
Rgb bend(const VertexRow& row, const Rgb& from, const Rgb& to, std::span<const Rgb> values);

/// The value in the middle of an edge: the mean of its ends, and the bend where a row is known.
Rgb edge_mean(const std::optional<VertexRow>& row, std::uint32_t from, std::uint32_t to,
              std::span<const Rgb> values);

/// The value at a vertex that lies between others, out of theirs: an edge's mean, or the middle of
/// the surface through a quad's edges (Coons, "Surfaces for computer-aided design of space forms",
/// 1967).
Rgb curved_mean(const RefinementTree& tree, const TreeVertex& vertex, std::span<const Rgb> values);

/// Sum of the squares of the weights that a middle's value takes of others', which is what it takes
/// of their noise [1].
double edge_noise(bool bent);
double quad_noise(bool bent);

}  // namespace patchlight
