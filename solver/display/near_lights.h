#pragma once

#include "solver/display/light_sources.h"
#include "solver/display/refinement_tree.h"

#include <vector>

namespace patchlight {

/// Which elements lie so near a light that its spot may fall between their corners. On a plane h
/// below a light of width w the spot is about max(h, w / 2) wide beyond the light's outline.
class NearLights {
  public:
    /// `sources` must outlive it.
    NearLights(const Scene& scene, const PatchMesh& mesh, const std::vector<LightSource>& sources);

    /// Whether an element is wider than the spot of a light it lies in, or beside.
    bool may_hide_spot(const RefinementTree& tree, const TreeElement& element) const;

  private:
    struct Light {
        const LightSource* source = nullptr;
        double width = 0.0;  // of its narrow side [m]
        Vec3 centre = Vec3::Zero();
        double radius = 0.0;  // of a sphere round it [m]
    };
    struct Disc {  // about an element
        Vec3 centre = Vec3::Zero(), normal = Vec3::UnitZ();
        double radius = 0.0;  // [m]
    };
    static bool hides_spot(const Disc& disc, const Light& light);

    const Scene& scene_;
    const PatchMesh& mesh_;
    std::vector<Light> lights_;
    std::vector<std::vector<std::uint32_t>> near_;  // per patch
};

}  // namespace patchlight
