#pragma once

#include "solver/display/aperture.h"
#include "solver/display/light_sources.h"
#include "solver/display/refinement_tree.h"
#include "solver/rays/patch_locator.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// Where light that sources send through apertures lands, and how narrow the spots are that it
/// makes there: vertices between which a spot may lie unseen are too far apart.
class LightSpots {
  public:
    LightSpots(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
               const std::vector<LightSource>& sources, const std::vector<Aperture>& apertures,
               std::uint64_t seed);

    /// Whether an element holds a place in a spot that is narrower.
    bool may_hide_spot(const RefinementTree& tree, const TreeElement& element) const;

  private:
    struct Spot {
        Vec3 place = Vec3::Zero();  // [m]
        double width = 0.0;         // [m]
    };
    std::vector<std::vector<Spot>> spots_;  // per patch; empty: no apertures
};

}  // namespace patchlight
