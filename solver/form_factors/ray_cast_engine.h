#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/form_factors/hemisphere_rays.h"
#include "solver/rays/patch_locator.h"
#include "solver/rays/ray_scene.h"

namespace patchlight {

/// Form factors by counting where rays land: every ray lands on a front, on a back or outside, so
/// closure holds to rounding. F_ij is a share of `rays` hits; its variance F(1-F)/rays is what
/// independent rays would have, an upper estimate for the scrambled Sobol points that are used.
class RayCastEngine final : public FormFactorEngine {
  public:
    RayCastEngine(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene, int rays,
                  std::uint64_t seed);

    bool pairwise() const override { return false; }
    void row(PatchIndex i, FactorRow& row) const override;
    Outside outside(PatchIndex i) const override;

  private:
    struct Tally {
        std::vector<std::uint32_t> hits;  // per patch; empty if they are not wanted
        std::uint32_t backs = 0, escaped = 0;
    };
    void cast(PatchIndex i, Tally& tally) const;

    const PatchMesh& mesh_;
    const RayScene& ray_scene_;
    PatchLocator locator_;
    HemisphereRays hemisphere_;
};

}  // namespace patchlight
