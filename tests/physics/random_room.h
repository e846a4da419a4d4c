#pragma once

#include "solver/scene/scene.h"

namespace patchlight {

/// A room of random size and paints with two to five boxes, some turned, some in mid-air, and one
/// to three lamps, some of which face the ceiling; every third room lacks its front wall.
Scene random_room(unsigned seed);

}  // namespace patchlight
