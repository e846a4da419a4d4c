#pragma once

#include "solver/display/edge_middles.h"
#include "solver/display/flat_corners.h"
#include "solver/mesh/patch_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace patchlight {

/// A quad or triangle (last vertex repeated) of the tree; cut into four at the middles of its
/// edges.
struct TreeElement {
    std::array<std::uint32_t, 4> vertices{};  // counter-clockwise from the front
    PatchIndex patch = 0;                     // the root it came from
    std::uint32_t first_child = 0;            // of four; 0: a leaf
    double area = 0.0;                        // [m²]
    std::uint8_t creases = 0;                 // bit k: the edge from vertex k on lies on a crease
    std::uint8_t level = 0;                   // 0: a root

    bool is_triangle() const { return vertices[3] == vertices[2]; }
    std::size_t corner_count() const { return is_triangle() ? 3 : 4; }
    bool is_leaf() const { return first_child == 0; }
};

/// Three vertices in a row, equally far apart, of the element an edge was cut out of: how a field
/// bends along them is how it bends along the edge.
using VertexRow = std::array<std::uint32_t, 3>;

/// Vertices are numbered so that a vertex comes after those it lies between, and those of its row.
struct TreeVertex {
    Vec3 position = Vec3::Zero();            // [m]
    PatchIndex patch = 0;                    // a root it is part of
    std::array<std::uint32_t, 4> parents{};  // the ends of its edge, or the middles round a quad
    std::uint8_t parent_count = 0;           // 0 at the corners of roots
    std::optional<VertexRow> row;            // of a middle of an edge below the roots
};

/// Patches as roots of quadtrees that share their vertices, so that irradiance can be refined where
/// it needs to be. Vertices are shared within a plane and not across creases.
class RefinementTree {
  public:
    RefinementTree(const PatchMesh& mesh, const FlatCorners& corners);

    const std::vector<TreeVertex>& vertices() const { return vertices_; }
    const std::vector<TreeElement>& elements() const { return elements_; }

    /// Cuts a leaf; nothing if it is none.
    void split(std::uint32_t element);
    /// Whether an edge of an element is cut in more than two, by vertices that count.
    template <typename Counts>
    bool is_cut_twice(const TreeElement& element, const Counts& counts) const;
    /// Splits leaves until none has an edge cut in more than two. Those that were split, in order.
    std::vector<std::uint32_t> balance();

    static constexpr std::uint32_t none = EdgeMiddles::none;
    /// The vertex in the middle of the edge from corner k on, if either side was cut there.
    std::uint32_t middle(const TreeElement& element, std::size_t k) const;
    /// The vertex in the middle of a quad that was split; none of a triangle.
    std::uint32_t centre(const TreeElement& element) const;
    /// The row along the edge from corner k on; none of a root.
    std::optional<VertexRow> row(const TreeElement& element, std::size_t k) const;

  private:
    using Edge = EdgeMiddles::Edge;  // its owner: 0, or on a crease the root's number and 1
    static Edge edge_of(const TreeElement& element, std::size_t k);
    Edge half(const TreeElement& element, std::size_t k, std::uint32_t end,
              std::uint32_t middle) const;
    std::uint32_t make_middle(const TreeElement& element, std::size_t k);
    std::optional<VertexRow> row_past(std::uint32_t a, std::uint32_t b) const;
    std::optional<VertexRow> row_inside_triangle(std::uint32_t a, std::uint32_t b,
                                                 PatchIndex patch) const;
    void add_child(const TreeElement& parent, const std::array<std::uint32_t, 4>& vertices,
                   std::uint8_t creases);
    std::vector<TreeVertex> vertices_;
    std::vector<TreeElement> elements_;
    EdgeMiddles middles_;
    std::size_t balanced_ = 0;  // elements there were when that was last done
};

inline RefinementTree::Edge RefinementTree::edge_of(const TreeElement& element, std::size_t k) {
    const std::uint32_t a = element.vertices[k],
                        b = element.vertices[(k + 1) % element.corner_count()];
    const bool crease = (element.creases >> k) & 1u;
    return {std::min(a, b), std::max(a, b), crease ? element.patch + 1 : 0};
}

inline RefinementTree::Edge RefinementTree::half(const TreeElement& element, std::size_t k,
                                                 std::uint32_t end, std::uint32_t middle) const {
    return {std::min(end, middle), std::max(end, middle), edge_of(element, k).owner};
}

inline std::uint32_t RefinementTree::middle(const TreeElement& element, std::size_t k) const {
    return middles_.find(edge_of(element, k));
}

template <typename Counts>
bool RefinementTree::is_cut_twice(const TreeElement& element, const Counts& counts) const {
    for (std::size_t k = 0; k < element.corner_count(); ++k) {
        const std::uint32_t m = middle(element, k);
        if (m == none || !counts(m)) continue;
        const Edge edge = edge_of(element, k);
        for (const std::uint32_t end : {edge.a, edge.b})
            if (const std::uint32_t found = middles_.find(half(element, k, end, m));
                found != none && counts(found))
                return true;
    }
    return false;
}

}  // namespace patchlight
