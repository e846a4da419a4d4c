#pragma once

#include "solver/findings/flaw_search.h"

#include <vector>

namespace patchlight {

/// Tells of lamps whose light meets no front of any surface, nor a sensor: it escapes, or ends at
/// backs, which absorb it. `backs_are_told`: that backs are turned to the light is known already.
std::vector<Finding> find_wasted_light(const FlawSearch& search, bool backs_are_told);

}  // namespace patchlight
