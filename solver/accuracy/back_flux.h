#pragma once

#include "solver/accuracy/shown_places.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// Light of a displayed field that lands on backs, gathered there.
struct BackFlux {
    Rgb flux = Rgb::Zero();      // [W]
    Rgb variance = Rgb::Zero();  // of it [W²]
    std::vector<bool> gathered;  // per surface: whether its back is in the sum
};

/// Rays from points on backs tell how bright it is where they land. A small back in a bright room
/// takes far fewer of them than rays from all that is bright, of which few meet it. Backs that a
/// few first rays see no light from are left to those: most of them face away from all light.
/// About `count` rays; none where there are too many surfaces to look at each.
BackFlux gather_at_backs(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                         const TreeDisplay& shown, const ShownPlaces& places, std::size_t count,
                         std::uint64_t seed);

}  // namespace patchlight
