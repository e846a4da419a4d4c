#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/form_factors/hemicube_view.h"
#include "solver/rays/patch_locator.h"
#include "solver/rays/patch_sampler.h"

#include <vector>

namespace patchlight {

struct HemicubeSettings {
    int resolution = 128;  // cells along the top face's edge; twice as many: half the aliasing
    /// Hemicubes along a patch's edge, k * k in all, each of the full resolution. 0: as many, up to
    /// four, as the nearest neighbour asks for, and then each of resolution / sqrt(k).
    int sub_samples = 0;
    bool rotated = true;  // about the normal, at random for each hemicube: no banding
    std::uint64_t seed = 1;
};

/// Form factors by hemicubes (Cohen & Greenberg, 1985) at the centres of k × k parts of each patch:
/// every cell sees a front, a back or nothing, so closure holds to rounding. Three assumptions are
/// wrong by construction (Baum, Rushmeier & Winget, 1989): that a patch is far for its size
/// (proximity; falls as 1/k²), that what its centres see the whole of it sees (visibility; falls
/// with k), and that a cell sees one patch only (aliasing; falls with the resolution). The variance
/// of an entry estimates proximity and aliasing.
class HemicubeEngine final : public FormFactorEngine {
  public:
    HemicubeEngine(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene,
                   const HemicubeSettings& settings);

    bool pairwise() const override { return false; }
    void row(PatchIndex i, FactorRow& row) const override;
    Outside outside(PatchIndex i) const override;

    /// Centres of the k × k parts of patch i, lifted off it, in metres.
    std::vector<Vec3> part_centres(PatchIndex i, int k) const;
    /// Which k is used for patch i.
    int sub_samples(PatchIndex i) const;

  private:
    struct Tally {
        std::vector<double> share;         // per patch [1]
        std::vector<std::uint32_t> cells;  // per patch
        double backs = 0.0, escaped = 0.0;
        double nearest = 0.0;  // distance [ray space]
        std::uint64_t rays = 0;
    };
    const HemicubeCells& cells_for(int k) const;
    HemicubePose pose(PatchIndex i, int k, int part) const;
    Tally look(PatchIndex i, int k) const;
    int wanted(PatchIndex i, double nearest) const;
    double variance(PatchIndex i, PatchIndex j, int k, const Tally& tally) const;

    const PatchMesh& mesh_;
    const RayScene& ray_scene_;
    HemicubeSettings settings_;
    HemicubeScene hemicube_scene_;
    PatchLocator locator_;
    std::vector<HemicubeCells> cells_;  // for k = 1, 2, …
    std::vector<PatchSampler> samplers_;
    std::vector<float> lift_;    // [ray space]
    std::vector<Vec3> normals_;  // of surfaces
};

}  // namespace patchlight
