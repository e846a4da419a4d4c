#pragma once

#include "raster/render.h"

#include <vector>

namespace patchlight::raster {

/// Triangles to draw, each with corners of its own.
struct Mesh {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Eigen::Array3d> colours;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    TriangleView view() const { return {positions, colours, triangles}; }
};

/// Adds a triangle of one colour.
void add_triangle(Mesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                  const Eigen::Vector3d& c, const Eigen::Array3d& colour = Eigen::Array3d::Ones());

/// Adds the parallelogram origin, origin + u, origin + u + v, origin + v cut into cuts² quads of
/// two triangles; its front is where u × v points.
void add_wall(Mesh& mesh, const Eigen::Vector3d& origin, const Eigen::Vector3d& u,
              const Eigen::Vector3d& v, int cuts, const Eigen::Array3d& colour);

/// A box of six walls, each in its own colour; fronts inside unless outward.
void add_box(Mesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& size, int cuts,
             bool outward);

/// The room [0, 1]³ seen from inside, with a block on its floor: 24 cuts² triangles.
Mesh room_with_block(int cuts);
/// Looks into that room along -z from near its wall z = 1.
Camera room_camera(int size);

/// One channel of a pixel.
float value_at(const Image& image, int x, int y, int channel = 0);

}  // namespace patchlight::raster
