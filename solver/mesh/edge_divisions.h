#pragma once

#include "solver/mesh/patch_mesh.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace patchlight {

/// Into how many equal parts each edge of each surface is cut. An edge that two surfaces share
/// whole is one edge: both are cut at the same points.
class EdgeDivisions {
  public:
    /// `gridded[s]`: surface s is a quad that shall become a grid, so opposite edges get one count.
    EdgeDivisions(const Scene& scene, const std::vector<bool>& gridded, double patch_size);

    /// Number of the vertex at corner k of surface s.
    VertexIndex corner(SurfaceIndex s, std::size_t k) const {
        return corners_[first_corner_[s] + k];
    }
    /// Parts of the edge from corner k to the next.
    int parts(SurfaceIndex s, std::size_t k) const { return parts_[edges_[first_corner_[s] + k]]; }
    /// Vertices of that edge, both ends included, in the direction of the surface.
    std::vector<VertexIndex> points(SurfaceIndex s, std::size_t k) const;
    /// Positions of all corners and division points [m].
    std::vector<Vec3> vertices() const;

  private:
    void weld(const Scene& scene);
    void find_edges(const Scene& scene);
    void count_parts(const Scene& scene, const std::vector<bool>& gridded, double patch_size);

    std::vector<std::size_t> first_corner_;                  // per surface
    std::vector<VertexIndex> corners_;                       // per corner of each surface
    std::vector<std::uint32_t> edges_;                       // per corner: the edge that leaves it
    std::vector<Vec3> positions_;                            // of welded corners [m]
    std::vector<std::pair<VertexIndex, VertexIndex>> ends_;  // per edge, lower number first
    std::vector<int> parts_;                                 // per edge
    std::vector<VertexIndex> first_inner_;                   // per edge: its first inner vertex
    std::size_t vertex_count_ = 0;
};

}  // namespace patchlight
