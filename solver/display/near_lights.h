#pragma once

#include "solver/display/aperture_set.h"
#include "solver/display/refinement_tree.h"

#include <vector>

namespace patchlight {

/// Which elements lie so near a light, or a gap that lamps shine through, that its spot may fall
/// between their corners. On a plane h below a light of width w the spot is about max(h, w / 2)
/// wide beyond the light's outline.
class NearLights {
  public:
    NearLights(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
               const std::vector<LightSource>& sources, const ApertureSet& apertures);

    /// Whether an element is wider than the spot of a light it lies in, or beside; those of gaps
    /// count where they hold more of √∫ E² dA than `little` [W/m].
    bool may_hide_spot(const RefinementTree& tree, const TreeElement& element, double little) const;

  private:
    struct Light {
        ConvexPolygon polygon;  // [m]
        Vec3 normal = Vec3::UnitZ();
        double width = 0.0;  // of its narrow side [m]
        double most;         // irradiance, of a gap; of a lamp: all there is [W/m²]
        Vec3 centre = Vec3::Zero();
        double radius = 0.0;  // of a sphere round it [m]
    };
    void add(const Light& light);
    struct Disc {  // about an element
        Vec3 centre = Vec3::Zero(), normal = Vec3::UnitZ();
        double radius = 0.0;  // [m]
    };
    static bool hides_spot(const Disc& disc, const Light& light, double little);

    const Scene& scene_;
    const PatchMesh& mesh_;
    std::vector<Light> lights_;
    std::vector<std::vector<std::uint32_t>> near_;  // per patch
};

}  // namespace patchlight
