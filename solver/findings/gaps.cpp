#include "solver/findings/gaps.h"

#include "solver/scene/touching_pairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <optional>

namespace patchlight {

namespace {

constexpr double widest_gap = 1e-2;          // of the size of what is around [1]
constexpr double widest_for_edge = 0.2;      // of the edge's length [1]
constexpr double crease = 0.866;             // cosine between normals, at most
constexpr double clear = 0.35;               // of its width that is empty round its middle [1]
constexpr std::size_t most_edges = 100'000;  // the longest ones
constexpr std::array<double, 3> places{0.5, 0.2, 0.8};  // along an edge [1]

bool is_open(const Scene& scene, const SurfaceEdge& edge) {
    if (edge.uses > 2) return false;
    return edge.is_free() || scene.surfaces[edge.surfaces[0]].normal.dot(
                                 scene.surfaces[edge.surfaces[1]].normal) < crease;
}

std::vector<std::size_t> open_edges(const FlawSearch& search, const SurfaceEdges& edges,
                                    std::span<const Crack> cracks) {
    std::vector<bool> cracked(edges.edges.size(), false);
    for (const Crack& crack : cracks) {
        cracked[crack.edge] = true;
        for (const std::size_t other : crack.others) cracked[other] = true;
    }
    std::vector<std::size_t> open;
    for (std::size_t e = 0; e < edges.edges.size(); ++e)
        if (!cracked[e] && is_open(search.scene, edges.edges[e])) open.push_back(e);
    std::stable_sort(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
        return edges.length(edges.edges[a]) > edges.length(edges.edges[b]);
    });
    if (open.size() > most_edges) open.resize(most_edges);
    return open;
}

/// The gap at p, a point of an edge: none if another surface touches the edge there, if nothing is
/// near, or if something fills the middle of the gap.
std::optional<Gap> gap_at(const SurfaceTree& tree, const SurfaceEdge& edge, const Vec3& p,
                          double contact, double reach) {
    std::optional<SurfaceTree::Near> nearest;
    std::size_t touching = 0;
    for (const SurfaceTree::Near& near : tree.within(p, reach)) {
        if (near.distance <= contact)
            ++touching;
        else if (!nearest || near.distance < nearest->distance)
            nearest = near;
    }
    if (!nearest || touching > edge.uses) return std::nullopt;
    const double width = nearest->distance;
    const Vec3 middle = 0.5 * (p + nearest->point);
    if (!tree.within(middle, clear * width).empty()) return std::nullopt;
    return Gap{0,
               edge.surfaces[0],
               nearest->surface,
               middle,
               (nearest->point - p) / width,
               Vec3::UnitY(),
               width};
}

}  // namespace

std::vector<Gap> find_gaps(const FlawSearch& search, const SurfaceEdges& edges,
                           const SurfaceTree& tree, std::span<const Crack> cracks) {
    const std::vector<std::size_t> open = open_edges(search, edges, cracks);
    std::vector<std::optional<Gap>> widest_of(open.size());
    for_each_in_parallel(open.size(), search.go_on, [&](std::size_t k) {
        const SurfaceEdge& edge = edges.edges[open[k]];
        const double length = edges.length(edge);
        const double contact = search.contact(edge.surfaces[0]);
        const double reach =
            std::min(widest_gap * search.size(edge.surfaces[0]), widest_for_edge * length);
        if (reach <= contact) return;
        for (const double t : places) {
            auto gap = gap_at(tree, edge, edges.at(edge, t), contact, reach);
            if (!gap || (widest_of[k] && widest_of[k]->width >= gap->width)) continue;
            gap->edge = open[k];
            gap->along = (edges.vertices[edge.ends[1]] - edges.vertices[edge.ends[0]]) / length;
            widest_of[k] = gap;
        }
    });
    std::vector<Gap> gaps;
    for (const auto& gap : widest_of)
        if (gap) gaps.push_back(*gap);
    return gaps;
}

}  // namespace patchlight
