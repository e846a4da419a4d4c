#pragma once

#include "solver/display/refinement_tree.h"
#include "solver/scene/scene.h"

#include <functional>
#include <span>
#include <vector>

namespace patchlight {

/// What a display was found to miss at a point.
struct PointMiss {
    PatchIndex patch = 0;
    Vec3 position = Vec3::Zero();  // [m]
    double square = 0.0;           // of what is reflected, luminance [W²/m⁴]
    Rgb irradiance = Rgb::Zero();  // there is [W/m²]
};

/// The child of a split element that a point is in, or that it misses by least.
std::uint32_t child_at(const RefinementTree& tree, const TreeElement& element, const Vec3& normal,
                       const Vec3& point);

/// Points where a layer of a display was found to miss something that its own vertices did not
/// show: fields that vary along a line as vertices lie are such. Elements round them are cut until
/// they show it, a few times at most.
class CloserLook {
  public:
    CloserLook(const Scene& scene, const PatchMesh& mesh, const RefinementTree& tree);

    /// `is_cut` tells whether a split element of the tree is one of the layer, too.
    void add(const RefinementTree& tree, std::span<const PointMiss> points,
             const std::function<bool(const TreeElement&)>& is_cut);

    bool empty() const { return places_.empty(); }
    /// For each point the leaf it is in, as `is_leaf` tells, if what is shown there still misses
    /// half of it: `at(leaf, square)`. `values` at the tree's vertices [W/m²].
    void each(const RefinementTree& tree, std::span<const Rgb> values,
              const std::function<bool(std::uint32_t)>& is_leaf,
              const std::function<void(std::uint32_t, double)>& at) const;

  private:
    struct Place {
        PointMiss point;
        int level = 0;  // of the leaf that it was found in
    };
    bool still_missed(const RefinementTree& tree, const TreeElement& leaf, const PointMiss& point,
                      std::span<const Rgb> values) const;
    template <typename StopsAt>
    std::uint32_t descend(const RefinementTree& tree, const PointMiss& point,
                          const StopsAt& stops_at) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    std::vector<std::uint32_t> root_of_;  // per patch; RefinementTree::none: covered
    std::vector<Place> places_;
};

}  // namespace patchlight
