#pragma once

#include "solver/scene/scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

using PatchIndex = std::uint32_t;
using VertexIndex = std::uint32_t;

/// A planar quad or triangle of one surface; a triangle repeats its last vertex.
struct Patch {
    std::array<VertexIndex, 4> vertices{};  // counter-clockwise from the front
    SurfaceIndex surface = 0;
    Vec3 centre = Vec3::Zero();  // centroid [m]
    double area = 0.0;           // [m²]; next to nothing where covered
    bool covered = false;        // wholly under a coplanar polygon listed later, or too narrow to
                                 // have an area: sees nothing

    bool is_triangle() const { return vertices[3] == vertices[2]; }
    std::size_t corner_count() const { return is_triangle() ? 3 : 4; }
};

/// Patches of a scene, grouped by surface: surface s owns patches first_of_surface[s] up to
/// first_of_surface[s + 1]. Vertices are shared, so that neighbours can be found.
struct PatchMesh {
    std::vector<Vec3> vertices;  // [m]
    std::vector<Patch> patches;
    std::vector<PatchIndex> first_of_surface;
    std::vector<std::array<std::uint32_t, 2>> grid;   // per surface: cells along edges 0-1 and 1-2
                                                      // of a grid, row by row; {0, 0} if it is none
    std::vector<std::array<VertexIndex, 2>> creases;  // edges on which another surface stands or a
                                                      // cover ends; lower vertex first, sorted
    double patch_size = 0.0;                          // longest edge asked for [m]

    std::size_t size() const { return patches.size(); }
    bool is_crease(VertexIndex a, VertexIndex b) const {
        const std::array<VertexIndex, 2> edge{std::min(a, b), std::max(a, b)};
        return std::binary_search(creases.begin(), creases.end(), edge);
    }
};

}  // namespace patchlight
