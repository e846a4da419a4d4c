#pragma once

#include "solver/scene/holes.h"

#include <span>

namespace patchlight {

/// The rings of a polygon whose corners run round its holes, too, to and fro along bridges: each an
/// edge that is met twice, in opposite directions. The one ring it is given as, if it has none.
/// Points no farther apart than `same_point` are one [m].
Rings<Vec3> without_bridges(std::span<const Vec3> corners, double same_point);

}  // namespace patchlight
