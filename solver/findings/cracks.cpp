#include "solver/findings/cracks.h"

#include "solver/scene/finding_words.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace patchlight {

namespace {

constexpr double widest = 0.01;   // of the edge's length [1]
constexpr int longest_way = 256;  // edges beside one

/// Free edges by the vertices at their ends.
class FreeEdges {
  public:
    explicit FreeEdges(const SurfaceEdges& all) : all_(all), first_(all.vertices.size() + 1, 0) {
        for (const SurfaceEdge& edge : all.edges)
            if (edge.is_free())
                for (const std::uint32_t v : edge.ends) ++first_[v + 1];
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        edges_.resize(first_.back());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::size_t e = 0; e < all.edges.size(); ++e)
            if (all.edges[e].is_free())
                for (const std::uint32_t v : all.edges[e].ends) edges_[next[v]++] = e;
    }
    std::span<const std::size_t> at(std::uint32_t v) const {
        return std::span(edges_).subspan(first_[v], first_[v + 1] - first_[v]);
    }
    /// Follows free edges that run along `edge` within `reach` of it, from its first end to its
    /// second. Nothing if they do not get there.
    std::optional<Crack> beside(std::size_t edge, double reach) const;

  private:
    const SurfaceEdges& all_;
    std::vector<std::size_t> first_, edges_;
};

std::optional<Crack> FreeEdges::beside(std::size_t edge, double reach) const {
    const std::array<std::uint32_t, 2> ends = all_.edges[edge].ends;
    const Vec3 start = all_.vertices[ends[0]];
    const double length = all_.length(all_.edges[edge]);
    const Vec3 along = (all_.vertices[ends[1]] - start) / length;
    Crack crack{edge, {}, 0, start, 0.0};
    const SurfaceIndex owner = all_.edges[edge].surfaces[0];
    std::uint32_t v = ends[0];
    double passed = 0.0;
    for (int step = 0; step < longest_way; ++step) {
        std::size_t taken = edge;
        for (const std::size_t other : at(v)) {
            const auto& pair = all_.edges[other].ends;
            const std::uint32_t w = pair[0] == v ? pair[1] : pair[0];
            const Vec3 way = all_.vertices[w] - start;
            const double t = way.dot(along), off = (way - t * along).norm();
            if (all_.edges[other].surfaces[0] == owner || off > reach || t <= passed ||
                t > length + reach)
                continue;
            taken = other;
            crack.others.push_back(other);
            crack.beside = off > crack.width ? all_.edges[other].surfaces[0] : crack.beside;
            if (off > crack.width) crack.place = all_.vertices[w];
            crack.width = std::max(crack.width, off);
            v = w;
            passed = t;
            break;
        }
        if (v == ends[1] && taken != edge) return step > 0 ? std::optional(crack) : std::nullopt;
        if (taken == edge) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

std::vector<Crack> find_cracks(const FlawSearch& search, const SurfaceEdges& edges) {
    const FreeEdges free_edges(edges);
    std::vector<Crack> cracks;
    for (std::size_t e = 0; e < edges.edges.size(); ++e) {
        const double reach = widest * edges.length(edges.edges[e]),
                     contact = search.contact(edges.edges[e].surfaces[0]);
        if (!edges.edges[e].is_free() || reach <= contact) continue;
        const std::optional<Crack> crack = free_edges.beside(e, reach);
        if (crack && crack->width > contact) cracks.push_back(*crack);
    }
    return cracks;
}

std::vector<Finding> crack_findings(const FlawSearch& search, const SurfaceEdges& edges,
                                    std::span<const Crack> cracks) {
    std::map<std::pair<ObjectIndex, ObjectIndex>, std::pair<Crack, std::size_t>> pairs;
    for (const Crack& crack : cracks) {
        const SurfaceIndex owner = edges.edges[crack.edge].surfaces[0];
        auto& [most, count] = pairs[{search.scene.surfaces[owner].object,
                                     search.scene.surfaces[crack.beside].object}];
        ++count;
        if (crack.width > most.width) most = crack;
    }
    std::vector<Finding> findings;
    for (const auto& [objects, widest_and_count] : pairs) {
        const auto& [crack, count] = widest_and_count;
        const std::string &edge = search.scene.objects[objects.first].name,
                          &vertex = search.scene.objects[objects.second].name;
        Finding finding{"t-vertex", {vertex}, "", "", count};
        if (edge != vertex) finding.objects.push_back(edge);
        finding.detail = "a vertex of " + quoted(vertex) + " at " +
                         place_text(crack.place, search.size(edges.edges[crack.edge].surfaces[0])) +
                         " is " + length_text(crack.width) + " off the edge of " +
                         (edge == vertex ? "its neighbour" : quoted(edge)) +
                         " that it stands beside: light passes the crack, and shading breaks there";
        finding.remedy = "give the edge a corner at that vertex, or move the vertex onto the edge";
        findings.push_back(std::move(finding));
    }
    return findings;
}

}  // namespace patchlight
