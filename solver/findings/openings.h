#pragma once

#include "solver/findings/flaw_search.h"

#include <span>
#include <vector>

namespace patchlight {

/// A narrow gap along an edge.
struct Slit {
    Vec3 from, to;       // ends of the edge [m]
    double width = 0.0;  // [m]
};

/// "open-enclosure": of the light that lamps sent on its way, some escapes, but less than
/// 3 % at each flight: a room with a hole, such as a wall panel that was forgotten, and no
/// open scene. What escapes through gaps that are told of already does not count.
std::vector<Finding> find_openings(const FlawSearch& search, std::span<const Slit> slits);

}  // namespace patchlight
