#pragma once

#include "solver/findings/flaw_search.h"

#include <vector>

namespace patchlight {

/// "sliver": polygons more than 500 times as long as they are wide on average (their area over
/// their length). They are cut across into up to 256 patches, and light over them is poorly
/// resolved where they are longer still. One finding for each object, with its narrowest.
std::vector<Finding> find_slivers(const FlawSearch& search);

}  // namespace patchlight
