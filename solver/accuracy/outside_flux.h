#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/rays/ray_scene.h"
#include "solver/solution.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// Light of a displayed field that meets backs or leaves the scene, counted by rays [W].
struct OutsideFlux {
    Rgb backs = Rgb::Zero(), escaped = Rgb::Zero();
    Rgb standard_error = Rgb::Zero();  // of both together
    Rgb on_gathered = Rgb::Zero();     // on backs that are gathered at, in neither
    Rgb error_on_gathered = Rgb::Zero();
};

/// `count` rays start where the display is bright, in proportion to its luminance, cosine-
/// distributed: 4 times as many, at most half the noise. Where none of them goes astray the sums
/// are exactly 0. Backs that are gathered at, per surface, are not counted.
OutsideFlux measure_outside(const Scene& scene, const PatchMesh& mesh, const DisplayMesh& display,
                            const RayScene& rays, const std::vector<bool>& gathered,
                            std::size_t count, std::uint64_t seed);

}  // namespace patchlight
