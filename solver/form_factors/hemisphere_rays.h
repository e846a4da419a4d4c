#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/rays/patch_sampler.h"
#include "solver/rays/ray_scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// Rays that leave a patch as its light does: origins uniform over its area, directions with
/// density cosine over pi. Scrambled Sobol points in these four dimensions, a scramble of its own
/// for each (seed, patch).
class HemisphereRays {
  public:
    HemisphereRays(const Scene& scene, const PatchMesh& mesh, const RayScene& rays, int count,
                   std::uint64_t seed);

    int count() const { return static_cast<int>(points_.size()); }
    /// Rays number `first` up to `first + ray_batch` of patch i (less past the last); how many.
    int fill(PatchIndex i, int first, RayBatch& batch) const;

    const PatchSampler& sampler(PatchIndex i) const { return samplers_[i]; }
    /// Where the patch's rays start above it [ray space].
    float lift(PatchIndex i) const { return lift_[i]; }

  private:
    SobolPoints points_;
    std::vector<PatchSampler> samplers_;
    std::vector<float> lift_;
    std::uint64_t seed_;
};

}  // namespace patchlight
