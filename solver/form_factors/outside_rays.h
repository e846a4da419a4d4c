#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/form_factors/hemisphere_rays.h"

#include <vector>

namespace patchlight {

/// Per patch, to tell how much of its light can meet a front at all.
constexpr int probe_rays = 64;

/// Tells by rays how much of a patch's light lands on backs or leaves the scene.
class OutsideRays {
  public:
    /// `count` rays per patch: 4 times as many, half the noise.
    OutsideRays(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene, int count,
                std::uint64_t seed)
        : mesh_(mesh), ray_scene_(ray_scene), rays_(scene, mesh, ray_scene, count, seed) {}

    /// Of a covered patch all lands on backs.
    Outside at(PatchIndex i) const;
    /// Of all patches, in parallel.
    std::vector<Outside> everywhere() const;

    const HemisphereRays& rays() const { return rays_; }

  private:
    const PatchMesh& mesh_;
    const RayScene& ray_scene_;
    HemisphereRays rays_;
};

}  // namespace patchlight
