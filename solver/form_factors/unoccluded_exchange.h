#pragma once

#include "solver/form_factors/convex_polygon.h"
#include "solver/form_factors/patch_points.h"
#include "solver/mesh/patch_mesh.h"
#include "solver/scene/local_tolerance.h"
#include "solver/scene/plane_groups.h"

#include <vector>

namespace patchlight {

/// A_i F_ij of patches with nothing between them, to about 3e-7: products of Gauss rules when far
/// apart for their size, the contour integral when near, both clipped at each other's planes first.
class UnoccludedExchange {
  public:
    UnoccludedExchange(const Scene& scene, const PatchMesh& mesh, const PlaneGroups& groups);

    /// 0, exactly, for patches of one surface, coplanar ones and those facing away [m²].
    double operator()(PatchIndex i, PatchIndex j) const;

  private:
    enum class Place : unsigned char { behind, cut, in_front };
    Place place(PatchIndex i, SurfaceIndex of) const;
    /// What rises no higher above a plane lies on it, and faces nothing there [m].
    double contact(SurfaceIndex s, SurfaceIndex of) const {
        return 0.5 * tolerance_.between(s, of);
    }
    Place place_of_group(const std::vector<SurfaceIndex>& group,
                         const std::vector<SurfaceIndex>& before) const;
    double clipped(PatchIndex i, PatchIndex j) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    LocalTolerance tolerance_;
    std::vector<double> flat_;  // per surface: depths up to this need no clipping [m]
    std::vector<ConvexPolygon> polygons_;
    std::vector<double> radius_;           // of patches about their centres [m]
    std::vector<std::uint32_t> group_of_;  // plane group of each surface
    std::size_t group_count_;
    std::vector<Place> group_place_;  // of plane group g before group h, at g * groups + h
    PatchPoints points2_, points3_, points4_;
};

}  // namespace patchlight
