#pragma once

#include "solver/findings/flaw_search.h"
#include "solver/findings/viewpoint.h"

#include <span>
#include <vector>

namespace patchlight {

/// What lies in a solid, under the floor or outside the room, where no light is meant to be.
struct Misplaced {
    std::vector<bool> sensors;  // whether it does, as in scene.sensors; none if there are none
    std::vector<Finding> findings;
};

/// Those that see backs of surfaces and no front: of a sensor, what lies before it decides.
Misplaced find_misplaced(const FlawSearch& search, std::span<const Viewpoint> viewpoints);

}  // namespace patchlight
