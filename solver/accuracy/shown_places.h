#pragma once

#include "solver/display/refinement_tree.h"
#include "solver/display/tree_display.h"
#include "solver/rays/patch_locator.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace patchlight {

/// Finds the triangle that is shown at a point: down the tree that the display was made of, which
/// may have grown since. All that it is given must outlive it.
class ShownPlaces {
  public:
    ShownPlaces(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                const PatchLocator& locator, const RefinementTree& tree, const TreeDisplay& shown);

    struct Place {
        std::uint32_t triangle = 0;      // of the display
        std::array<double, 3> weight{};  // of its corners, none below 0, sum 1
    };
    /// Of a point on surface s, in its frame [ray space]. A point that rounding has put beside all
    /// triangles takes the one it misses by least. None where nothing is displayed.
    std::optional<Place> find(SurfaceIndex s, const RayPoint& position) const;

  private:
    bool is_shown(std::uint32_t element) const;

    const Scene& scene_;
    const RayScene& rays_;
    const PatchLocator& locator_;
    const RefinementTree& tree_;
    const TreeDisplay& shown_;
    std::vector<std::uint32_t> root_of_;  // per patch; RefinementTree::none: covered
};

}  // namespace patchlight
