#pragma once

#include "solver/scene/polygon.h"

#include <cstdint>
#include <string>
#include <vector>

namespace patchlight {

/// Rings of corners: the first is the outline, the others are holes in it.
template <typename Point>
using Rings = std::vector<std::vector<Point>>;

/// Why rings do not bound one area, such as "a hole touches …"; empty if they do. Closer than
/// `touching` is in contact.
std::string fault_of(const Rings<Vec2>& rings, double touching);

/// Convex pieces of what the outline, counter-clockwise, holds and the holes, clockwise, leave.
/// Corners are numbered ring after ring; pieces meet in whole edges. `triangles`: pieces are not
/// merged. Empty if rounding leaves none. Holes are bridged and ears clipped (Eberly,
/// "Triangulation by Ear Clipping", 2002), then diagonals dropped (Hertel & Mehlhorn, 1983).
std::vector<std::vector<std::uint32_t>> cut_round_holes(const Rings<Vec2>& rings, bool triangles);

}  // namespace patchlight
