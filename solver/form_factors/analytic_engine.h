#pragma once

#include "solver/form_factors/blocker_table.h"
#include "solver/form_factors/form_factor_engine.h"
#include "solver/form_factors/outside_rays.h"
#include "solver/form_factors/pair_visibility.h"
#include "solver/form_factors/unoccluded_exchange.h"

namespace patchlight {

struct AnalyticSettings {
    int rays = 1024;  // per patch, shared among the pairs that something may block, by their factor
    int outside_rays =
        256;  // per patch, to tell backs from escapes; 4 times as many: half the noise
    std::uint64_t seed = 1;
};

/// Form factors by closed forms and quadrature (to about 3e-7) times visibility, which rays measure
/// for the pairs that something may block, and for those alone: exact where nothing blocks.
/// Rays belong to the unordered pair, so A_i F_ij = A_j F_ji.
/// `go_on` is asked while it is made; after a false its rows are as right, but slow.
class AnalyticEngine final : public FormFactorEngine {
  public:
    AnalyticEngine(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene,
                   const AnalyticSettings& settings, const std::function<bool()>& go_on = {});

    bool pairwise() const override { return true; }
    void row(PatchIndex i, FactorRow& row) const override;
    void whole_row(PatchIndex i, FactorRow& whole) const override;
    Outside outside(PatchIndex i) const override;

  private:
    void fill(PatchIndex i, PatchIndex first, FactorRow& row) const;
    std::vector<std::uint32_t> find_sheets(const Scene& scene) const;
    std::vector<VisibilityQuery> first_queries(const FactorRow& row, PatchIndex i) const;
    void refine(std::vector<VisibilityQuery>& queries) const;

    const PatchMesh& mesh_;
    const RayScene& ray_scene_;
    AnalyticSettings settings_;
    PlaneGroups groups_;
    UnoccludedExchange exchange_;
    BlockerTable blockers_;
    OutsideRays outside_rays_;
    PairVisibility visibility_;
    std::vector<std::uint32_t> sheet_;  // of each patch
};

}  // namespace patchlight
