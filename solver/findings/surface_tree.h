#pragma once

#include "solver/scene/scene.h"

#include <unsupported/Eigen/BVH>

#include <memory>
#include <vector>

namespace patchlight {

using Box = Eigen::AlignedBox3d;  // [m]

/// The point of a surface nearest to p.
Vec3 nearest_point(const Surface& surface, const Vec3& p);

/// Finds the surfaces near a place, by a tree of the boxes round them. Back halves of two-sided
/// polygons, which lie where their fronts do, are left out.
class SurfaceTree {
  public:
    explicit SurfaceTree(const Scene& scene);
    /// Of some of its surfaces alone.
    SurfaceTree only(const std::vector<SurfaceIndex>& surfaces) const;

    const Box& box(SurfaceIndex s) const { return (*boxes_)[s]; }

    /// Surfaces whose boxes meet `box`.
    std::vector<SurfaceIndex> over(const Box& box) const;
    /// Surfaces that come within `reach` of p.
    struct Near {
        SurfaceIndex surface = 0;
        double distance = 0.0;      // [m]
        Vec3 point = Vec3::Zero();  // of the surface, nearest to p [m]
    };
    std::vector<Near> within(const Vec3& p, double reach) const;

  private:
    SurfaceTree(const Scene& scene, std::shared_ptr<const std::vector<Box>> boxes,
                std::vector<SurfaceIndex> listed);

    const Scene& scene_;
    std::shared_ptr<const std::vector<Box>> boxes_;  // of all surfaces
    std::vector<SurfaceIndex> listed_;
    Eigen::KdBVH<double, 3, SurfaceIndex> tree_;
};

}  // namespace patchlight
