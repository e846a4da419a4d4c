#include "tests/raster/meshes.h"

#include <algorithm>

namespace patchlight::raster {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

/// Lighter towards the top, so that walls are not flat.
void shade_by_height(Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.colours[i] *= 0.35 + 0.65 * mesh.positions[i].y();
}

}  // namespace

void add_triangle(Mesh& mesh, const Vector3d& a, const Vector3d& b, const Vector3d& c,
                  const Array3d& colour) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.colours.insert(mesh.colours.end(), 3, colour);
    mesh.triangles.push_back({first, first + 1, first + 2});
}

void add_wall(Mesh& mesh, const Vector3d& origin, const Vector3d& u, const Vector3d& v, int cuts,
              const Array3d& colour) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= cuts; ++j)
        for (int i = 0; i <= cuts; ++i)
            mesh.positions.emplace_back(origin + u * i / cuts + v * j / cuts);
    mesh.colours.resize(mesh.positions.size(), colour);
    const auto corner = [&](int i, int j) {
        return first + static_cast<std::uint32_t>(j * (cuts + 1) + i);
    };
    for (int j = 0; j < cuts; ++j) {
        for (int i = 0; i < cuts; ++i) {
            mesh.triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
            mesh.triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
        }
    }
}

void add_box(Mesh& mesh, const Vector3d& low, const Vector3d& size, int cuts, bool outward) {
    const Vector3d x(size.x(), 0, 0);
    const Vector3d y(0, size.y(), 0);
    const Vector3d z(0, 0, size.z());
    const auto wall = [&](const Vector3d& origin, const Vector3d& u, const Vector3d& v,
                          const Array3d& colour) {
        add_wall(mesh, low + origin, outward ? v : u, outward ? u : v, cuts, colour);
    };
    const Vector3d none = Vector3d::Zero();
    wall(none, y, z, {0.9, 0.1, 0.1});  // x = 0
    wall(x, z, y, {0.1, 0.8, 0.1});     // x = 1
    wall(none, z, x, {0.8, 0.8, 0.8});  // y = 0
    wall(y, x, z, {1.0, 1.0, 0.9});     // y = 1
    wall(none, x, y, {0.5, 0.5, 0.9});  // z = 0
    wall(z, y, x, {0.6, 0.6, 0.2});     // z = 1
}

Mesh room_with_block(int cuts) {
    Mesh mesh;
    add_box(mesh, Vector3d::Zero(), Vector3d::Ones(), cuts, false);
    add_box(mesh, {0.35, 0.0, 0.3}, {0.3, 0.45, 0.3}, cuts, true);
    shade_by_height(mesh);
    return mesh;
}

Camera room_camera(int size) {
    Camera camera;
    camera.eye = {0.52, 0.55, 0.97};
    camera.look_at = {0.5, 0.4, 0.0};
    camera.vertical_fov = 75.0;
    camera.width = size;
    camera.height = size;
    return camera;
}

float value_at(const Image& image, int x, int y, int channel) {
    return image.rgb[static_cast<std::size_t>(3 * (y * image.width + x) + channel)];
}

}  // namespace patchlight::raster
