#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

namespace patchlight::raster {

enum class Projection { perspective, parallel };

/// Where the picture is taken from. In the terms of Foley, van Dam, Feiner & Hughes, "Computer
/// Graphics: Principles and Practice", 1990: eye is the view reference point, look_at - eye the
/// view plane normal and up the view up vector. Image x runs along (look_at - eye) × up.
struct Camera {
    Eigen::Vector3d eye = Eigen::Vector3d(0.0, 0.0, 1.0);  // [scene length]
    Eigen::Vector3d look_at = Eigen::Vector3d::Zero();     // [scene length]
    Eigen::Vector3d up = Eigen::Vector3d::UnitY();         // not along the view, any length
    Projection projection = Projection::perspective;
    double vertical_fov = 40.0;        // perspective: full angle from bottom to top [degrees]
    double view_height = 1.0;          // parallel: from bottom to top [scene length]
    int width = 512;                   // [pixels]
    int height = 512;                  // [pixels]
    std::optional<double> near_depth;  // nothing nearer is drawn; empty: from the bounds
    std::optional<double> far_depth;   // nothing farther is drawn; empty: from the bounds
};

/// Depths are measured from the eye along the view.
struct DepthRange {
    double near_depth = 0.0;
    double far_depth = 0.0;
};

/// Depths between which everything in front of the eye lies: 0 < near < far. Close to the eye the
/// near depth is a tiny part of the size of the bounds, so that walls beside the eye are kept.
DepthRange depth_range(const Camera& camera, const Eigen::AlignedBox3d& bounds);

/// World to view: eye at the origin, x to the right, y up, looking along -z. Throws
/// std::invalid_argument when eye, look_at and up span no view.
Eigen::Matrix4d view_from_world(const Camera& camera);

/// View to the canonical volume |x| <= w, |y| <= w, 0 <= z <= w, with z = w at the near depth,
/// z = 0 at the far depth, and w = 1 there for both projections. Throws std::invalid_argument when
/// angle, height, depths or size make no volume.
Eigen::Matrix4d canonical_from_view(const Camera& camera, const DepthRange& range);

/// The two above in one, with the depths that the camera leaves open taken from the bounds.
Eigen::Matrix4d canonical_from_world(const Camera& camera, const Eigen::AlignedBox3d& bounds);

/// A perspective camera that sees the whole box from in front (+z) and a little above to the right.
Camera framing(const Eigen::AlignedBox3d& bounds, int width, int height);

}  // namespace patchlight::raster
