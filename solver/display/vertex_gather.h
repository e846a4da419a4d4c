#pragma once

#include "solver/display/irradiance_layer.h"
#include "solver/display/irradiance_records.h"
#include "solver/display/point_gather.h"
#include "solver/mesh/patch_mesh.h"
#include "solver/scene/plane_groups.h"

#include <functional>
#include <span>
#include <vector>

namespace patchlight {

/// Gathers irradiance on patches: at vertices of a tree, in parallel, and at any other point.
class VertexGather {
  public:
    /// `go_on` is asked now and then; after a false what was gathered so far is all there is.
    VertexGather(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                 const PlaneGroups& planes, const PointGather& gather, std::uint64_t seed,
                 std::function<bool()> go_on);

    using Gathered = IrradianceLayer::Gathered;
    std::vector<Gathered> direct(const RefinementTree& tree,
                                 std::span<const std::uint32_t> vertices,
                                 const DirectEffort& effort) const;
    /// Vertices of several planes at one place are gathered at together from now on, where their
    /// normals differ from one by no more than this cosine: a tessellated surface has one set of
    /// rays for all its facets at a corner.
    void share_rays(double least_cosine) { least_cosine_ = least_cosine; }
    /// By rays [first, end) of each vertex' sequence, multiples of 32. Of many vertices that share
    /// rays most are lit by records at others, where those miss no more than `may_miss` of what is
    /// reflected, luminance [W/m²].
    std::vector<Gathered> indirect(const RefinementTree& tree,
                                   std::span<const std::uint32_t> vertices,
                                   const ReflectedField& field, int first, int end,
                                   double may_miss) const;

    /// A point of patch i, moved a little towards its centre so that no ray starts on the edge of
    /// another surface.
    GatherPoint point(PatchIndex i, const Vec3& position) const;
    std::size_t patches() const { return mesh_.size(); }
    SurfaceIndex surface_of(PatchIndex i) const { return mesh_.patches[i].surface; }
    const PointGather& gather() const { return gather_; }
    /// Whether something may stand between patch i and a source.
    bool may_be_shaded(PatchIndex i) const;

  private:
    const Rgb& reflectance_of(PatchIndex i) const;
    using Shared = std::vector<std::uint32_t>;  // places in a list of vertices
    std::vector<Shared> shared(const RefinementTree& tree,
                               std::span<const std::uint32_t> vertices) const;
    struct Request {  // for indirect light
        const RefinementTree& tree;
        std::span<const std::uint32_t> vertices;
        const std::vector<Shared>& groups;
        const ReflectedField& field;
        int first, end;  // rays
    };
    std::vector<Gathered> by_records(const Request& request, double may_miss) const;
    GatherPoint point_of(const Request& request, const Shared& group) const;
    bool sees(const GatherPoint& a, const GatherPoint& b) const;
    IrradianceRecord record(const Request& request, const Shared& group) const;
    GatherPoint shared_point(const RefinementTree& tree, std::span<const std::uint32_t> vertices,
                             const Shared& group, std::vector<Vec3>& normals) const;
    /// Parts of the list are done in an order that leaves what is done spread over all of it when
    /// the work is stopped.
    void each(std::size_t count, const std::function<void(std::size_t)>& at) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    const RayScene& rays_;
    const PointGather& gather_;
    std::uint64_t seed_;
    std::function<bool()> go_on_;
    double least_cosine_ = 2.0;             // none are shared
    std::vector<std::vector<bool>> clear_;  // per patch and source: nothing can stand between
};

}  // namespace patchlight
