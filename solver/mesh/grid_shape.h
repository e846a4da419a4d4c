#pragma once

#include "solver/scene/scene.h"

namespace patchlight {

/// A convex quad that a grid fits well: opposite edges of similar length, no sharp corner.
bool fits_a_grid(const Surface& surface);

/// Area over half the perimeter: about the width of a narrow polygon [m].
double width_of(const Surface& surface);

}  // namespace patchlight
