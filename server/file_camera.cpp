#include "server/file_camera.h"

#include <algorithm>
#include <cmath>

namespace patchlight::server {
namespace {

constexpr int longer_edge = 512;  // [pixels]

int shorter_edge(double share) {
    return std::max(1, static_cast<int>(std::lround(longer_edge * share)));
}

}  // namespace

NamedCamera placed_camera(const FileCamera& given, const Eigen::Affine3d& to_scene) {
    NamedCamera named;
    named.name = given.name.empty() ? "camera" : given.name;
    raster::Camera& camera = named.camera;
    camera.eye = to_scene * given.eye;
    const Vec3 view = (to_scene.linear() * given.view).normalized();
    camera.look_at = camera.eye + view;
    // A slanted scale may turn `up` off the square; only its part across the view counts.
    camera.up = (to_scene.linear() * given.up).normalized();
    camera.projection =
        given.vertical_fov ? raster::Projection::perspective : raster::Projection::parallel;
    if (given.vertical_fov) camera.vertical_fov = *given.vertical_fov;
    camera.view_height = given.height * (to_scene.linear() * given.up).norm();
    camera.width = given.aspect >= 1.0 ? longer_edge : shorter_edge(given.aspect);
    camera.height = given.aspect >= 1.0 ? shorter_edge(1.0 / given.aspect) : longer_edge;
    return named;
}

}  // namespace patchlight::server
