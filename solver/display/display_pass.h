#pragma once

#include "solver/display/irradiance_layer.h"
#include "solver/display/light_spots.h"
#include "solver/display/near_lights.h"
#include "solver/display/tree_display.h"
#include "solver/display/vertex_gather.h"

#include <functional>
#include <optional>

namespace patchlight {

/// Asked now and then, from the thread that called: after a false the work ends with what is there.
struct StopTokens {
    std::function<bool()> go_on;      // with gathering
    std::function<bool()> search_on;  // for gaps that light comes through
};

/// The displayed field of a mesh: direct and indirect irradiance, each gathered at vertices of its
/// own and refined by itself, on one tree.
class DisplayPass {
  public:
    /// What is missed of irradiance counts times the reflectance, but no less than this: who asks
    /// for the light on black surfaces gets it, too [1].
    static constexpr double least_weight = 0.1;

    DisplayPass(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                const MeshLines& lines, std::uint64_t seed, StopTokens stops);

    /// √∫ Y² dA of what interpolation may miss [W/m]. False if the work was stopped.
    struct Aim {
        double target = 0.0;    // √∫ Y² dA of what interpolation may miss [W/m]
        double elements = 1.0;  // the scene's area is cut in as many at least, for what hides [1]
    };
    /// False if the work was stopped. No more elements than needed where nothing can shade.
    bool refine_direct(const Aim& aim, const DirectEffort& effort);
    /// Where vertices were gathered with fewer rays before, the rest is joined to them: with the
    /// same field.
    bool refine_indirect(const Aim& aim, const ReflectedField& field, int rays);
    /// Where indirect light was found to be missed: gathered more closely from now on.
    void look_closer(std::span<const PointMiss> indirect);
    /// Forget what was gathered, so that it is gathered anew.
    void restart_direct();
    void restart_indirect();

    /// Cuts the tree until triangles miss no more of how the field bends between what was gathered
    /// than √∫ Y² dA [W/m].
    void show_bends(double missed);
    /// The field so far; `added` to the indirect irradiance of each patch, smoothly; or empty.
    TreeDisplay show(const std::vector<Rgb>& added);
    /// What direct light patches may have, where the work is stopped before it was gathered [W/m²].
    void guess_direct(std::vector<Rgb> of_patch) { guess_ = std::move(of_patch); }
    /// See VertexGather.
    void share_rays(double least_cosine) { points_.share_rays(least_cosine); }
    /// Whether most vertices are corners of patches, so that a coarser look takes as long.
    bool is_coarsest() const { return 2 * roots_ > indirect_->gathered(); }
    const RefinementTree& tree() const { return tree_; }
    const VertexGather& points() const { return points_; }
    const IrradianceLayer& direct() const { return *direct_; }
    const IrradianceLayer& indirect() const { return *indirect_; }
    double direct_noise() const { return direct_->noise(tree_); }      // √∫ Y² dA [W/m]
    double indirect_noise() const { return indirect_->noise(tree_); }  // √∫ Y² dA [W/m]

  private:
    SplitIrradiance at_all() const;
    double missed_bend(std::uint32_t leaf, const SplitIrradiance& arriving) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    const RayScene& rays_;
    PointGather gather_;
    VertexGather points_;
    NearLights near_lights_;
    LightSpots spots_;
    RefinementTree tree_;
    std::size_t roots_ = 0;  // vertices there were at first
    std::optional<IrradianceLayer> direct_, indirect_;
    CloserLook closer_;                // at indirect light
    int indirect_rays_ = 0;            // of each vertex so far
    std::size_t direct_gathered_ = 0;  // vertices, at most so far
    double area_ = 0.0;                // of what is not covered [m²]
    std::vector<Rgb> weight_;          // per patch, of irradiance that is missed [1]
    std::vector<Rgb> guess_;           // per patch, of direct light; or empty [W/m²]
};

}  // namespace patchlight
