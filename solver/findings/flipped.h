#pragma once

#include "solver/findings/flaw_search.h"

#include <vector>

namespace patchlight {

/// "flipped-normals": one-sided surfaces that light reaches at the back, while their front sees
/// nothing that sends any: it faces empty space or backs alone, or a closed hollow without a lamp.
/// Outward faces of solids, walls of rooms seen from outside and ground in the open are none: no
/// light is at their backs. One finding for each object. Of more than 80 000 surfaces the largest
/// are looked at.
std::vector<Finding> find_flipped(const FlawSearch& search);

}  // namespace patchlight
