#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/contact_lines.h"
#include "solver/scene/local_tolerance.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace patchlight {

/// About how many parts an edge of that length is cut into, beside patches so wide [m]; of any
/// width, if slivers are not cut.
double estimate_parts(double length, double patch_size, double width);

/// How each edge of each surface is cut: into equal parts, or between stops where creases end. An
/// edge that two surfaces share whole is one edge: both are cut at the same points.
class EdgeDivisions {
  public:
    /// `creases`: lines on each surface; where they meet an edge of it there will be a vertex.
    /// `hidden`: surfaces that need no division of their own. `cut_slivers`: edges of narrow
    /// patches are cut for their shape, too.
    EdgeDivisions(const Scene& scene, const std::vector<std::vector<Segment>>& creases,
                  const std::vector<bool>& hidden, double patch_size, bool cut_slivers);

    /// Whether surface s is a quad that becomes a grid: its opposite edges have one count.
    bool gridded(SurfaceIndex s) const { return gridded_[s]; }
    /// Number of the vertex at corner k of surface s.
    VertexIndex corner(SurfaceIndex s, std::size_t k) const {
        return corners_[first_corner_[s] + k];
    }
    /// Parts of the edge from corner k to the next.
    std::size_t parts(SurfaceIndex s, std::size_t k) const {
        return places_[edges_[first_corner_[s] + k]].size() + 1;
    }
    /// Vertices of that edge, both ends included, in the direction of the surface.
    std::vector<VertexIndex> points(SurfaceIndex s, std::size_t k) const;
    /// Positions of all corners and division points [m].
    std::vector<Vec3> vertices() const;

  private:
    void weld(const Scene& scene, const LocalTolerance& tolerance);
    void find_edges(const Scene& scene, const std::vector<bool>& hidden);
    void find_stops(const Scene& scene, const LocalTolerance& tolerance,
                    const std::vector<std::vector<Segment>>& creases);
    void choose_grids(const Scene& scene, const std::vector<std::vector<Segment>>& creases);
    void count_parts(const Scene& scene, double patch_size, bool cut_slivers);
    void place_points(double patch_size);

    std::vector<std::size_t> first_corner_;                  // per surface
    std::vector<VertexIndex> corners_;                       // per corner of each surface
    std::vector<std::uint32_t> edges_;                       // per corner: the edge that leaves it
    std::vector<Vec3> positions_;                            // of welded corners [m]
    std::vector<std::pair<VertexIndex, VertexIndex>> ends_;  // per edge, lower number first
    std::vector<double> coarseness_;  // per edge: the least of the surfaces that have it [1]
    std::vector<std::vector<double>> stops_;  // per edge: places along it in (0, 1), ascending
    std::vector<bool> gridded_;               // per surface
    std::vector<int> parts_;                  // per edge
    std::vector<std::vector<double>>
        places_;                            // per edge: of its inner points, in (0, 1), ascending
    std::vector<VertexIndex> first_inner_;  // per edge: number of its first inner point
    std::size_t vertex_count_ = 0;
};

}  // namespace patchlight
