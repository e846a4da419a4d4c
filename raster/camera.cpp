#include "raster/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace patchlight::raster {
namespace {

constexpr double nearest_share = 1e-5;   // least near depth, as a share of the size of the bounds
constexpr double depth_margin = 1e-3;    // keeps what lies on the bounds off the end planes
constexpr double framing_margin = 1.05;  // room around the box, as a factor on the distance

double tangent_of_half(double fov_in_degrees) {
    return std::tan(0.5 * fov_in_degrees * std::numbers::pi / 180.0);
}

Eigen::Vector3d corner_of(const Eigen::AlignedBox3d& box, int index) {
    return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(index));
}

void require(bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(what);
}

/// Half the width and height of what is seen at depth 1 (perspective) or at any depth (parallel).
Eigen::Array2d half_extent(const Camera& camera) {
    require(camera.width > 0 && camera.height > 0, "camera: the image has no pixels");
    double half_height = 0.0;
    switch (camera.projection) {
        case Projection::perspective:
            require(camera.vertical_fov > 0.0 && camera.vertical_fov < 180.0,
                    "camera: the field of view must lie between 0 and 180 degrees");
            half_height = tangent_of_half(camera.vertical_fov);
            break;
        case Projection::parallel:
            require(camera.view_height > 0.0 && std::isfinite(camera.view_height),
                    "camera: the view height must be above 0");
            half_height = 0.5 * camera.view_height;
            break;
    }
    return {half_height * camera.width / camera.height, half_height};
}

}  // namespace

DepthRange depth_range(const Camera& camera, const Eigen::AlignedBox3d& bounds) {
    if (bounds.isEmpty()) return {0.5, 1.0};
    const Eigen::Vector3d forward = (camera.look_at - camera.eye).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    double farthest = -nearest;
    for (int i = 0; i < 8; ++i) {
        const double depth = (corner_of(bounds, i) - camera.eye).dot(forward);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    const double reach = std::max(bounds.diagonal().norm(), farthest - nearest);
    const double size = reach > 0.0 ? reach : std::max(std::abs(farthest), 1.0);
    DepthRange range;
    range.near_depth = std::max(nearest - depth_margin * size, nearest_share * size);
    range.far_depth = std::max(farthest, range.near_depth) + depth_margin * size;
    return range;
}

Eigen::Matrix4d view_from_world(const Camera& camera) {
    const Eigen::Vector3d forward = (camera.look_at - camera.eye).normalized();
    const Eigen::Vector3d right = forward.cross(camera.up.normalized());
    // Written so that NaN is refused too.
    require(right.norm() > 1e-9, "camera: look_at must differ from eye, and up from the view");
    const Eigen::Vector3d x = right.normalized();
    Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
    view.block<1, 3>(0, 0) = x;
    view.block<1, 3>(1, 0) = x.cross(forward);
    view.block<1, 3>(2, 0) = -forward;
    view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * camera.eye;
    return view;
}

Eigen::Matrix4d canonical_from_view(const Camera& camera, const DepthRange& range) {
    const double n = range.near_depth;
    const double f = range.far_depth;
    require(n > 0.0 && f > n && std::isfinite(f), "camera: depths must be 0 < near < far");
    const Eigen::Array2d half = half_extent(camera);
    Eigen::Matrix4d canonical = Eigen::Matrix4d::Zero();
    switch (camera.projection) {
        case Projection::perspective:  // everything over f, so that w = depth / f
            canonical(0, 0) = 1.0 / (half.x() * f);
            canonical(1, 1) = 1.0 / (half.y() * f);
            canonical(2, 2) = n / (f * (f - n));
            canonical(2, 3) = n / (f - n);
            canonical(3, 2) = -1.0 / f;
            break;
        case Projection::parallel:
            canonical(0, 0) = 1.0 / half.x();
            canonical(1, 1) = 1.0 / half.y();
            canonical(2, 2) = 1.0 / (f - n);
            canonical(2, 3) = f / (f - n);
            canonical(3, 3) = 1.0;
            break;
    }
    return canonical;
}

Eigen::Matrix4d canonical_from_world(const Camera& camera, const Eigen::AlignedBox3d& bounds) {
    DepthRange range = depth_range(camera, bounds);
    range.near_depth = camera.near_depth.value_or(range.near_depth);
    range.far_depth = camera.far_depth.value_or(range.far_depth);
    // A depth from the bounds gives way to one that was asked for.
    if (range.near_depth >= range.far_depth && !camera.near_depth)
        range.near_depth = nearest_share * range.far_depth;
    if (range.near_depth >= range.far_depth && !camera.far_depth)
        range.far_depth = 2.0 * range.near_depth;
    return canonical_from_view(camera, range) * view_from_world(camera);
}

Camera framing(const Eigen::AlignedBox3d& bounds, int width, int height) {
    Camera camera;
    camera.width = width;
    camera.height = height;
    if (bounds.isEmpty()) return camera;
    camera.look_at = bounds.center();
    camera.eye = camera.look_at + Eigen::Vector3d(0.35, 0.3, 1.0);
    const Eigen::Matrix3d axes = view_from_world(camera).block<3, 3>(0, 0);
    const Eigen::Array2d half = half_extent(camera);
    double distance = 0.0;
    for (int i = 0; i < 8; ++i) {
        const Eigen::Vector3d corner = axes * (corner_of(bounds, i) - camera.look_at);
        distance = std::max(distance, corner.z() + std::abs(corner.x()) / half.x());
        distance = std::max(distance, corner.z() + std::abs(corner.y()) / half.y());
    }
    if (distance <= 0.0) distance = 1.0;
    camera.eye = camera.look_at + framing_margin * distance * axes.row(2).transpose();
    return camera;
}

}  // namespace patchlight::raster
