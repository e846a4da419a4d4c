#pragma once

#include "solver/findings/flaw_search.h"

#include <span>
#include <string>
#include <vector>

namespace patchlight {

/// A point from which pictures are taken.
struct Viewpoint {
    std::string name;
    Vec3 position = Vec3::Zero();  // [m]
};

/// What lies in a solid, under the floor or outside the room, where no light is meant to be.
struct Misplaced {
    std::vector<bool> sensors;  // whether it does, as in scene.sensors; none if there are none
    std::vector<Finding> findings;
};

/// Those that see backs of surfaces and no front: of a sensor, what lies before it decides.
Misplaced find_misplaced(const FlawSearch& search, std::span<const Viewpoint> viewpoints);

/// The same by itself.
Misplaced find_misplaced(const Scene& scene, std::span<const Viewpoint> viewpoints,
                         std::uint64_t seed);

}  // namespace patchlight
