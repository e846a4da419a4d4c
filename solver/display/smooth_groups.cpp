#include "solver/display/smooth_groups.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

namespace patchlight {

namespace {

constexpr double crease_cosine = 0.98480775301220802;  // of 10 degrees: more is a crease

bool smooth_between(const Surface& a, const Surface& b) {
    return a.object == b.object && a.material == b.material && a.side == b.side &&
           a.normal.dot(b.normal) >= crease_cosine;
}

struct Corner {
    PatchIndex patch = 0;
    std::size_t corner = 0;             // of the patch
    VertexIndex before = 0, after = 0;  // the vertices next to it round the patch
};

/// For each patch round vertex v, the first one of its smooth group.
std::vector<std::size_t> group_ring(const Scene& scene, const PatchMesh& mesh, VertexIndex v,
                                    std::span<const Corner> ring) {
    std::vector<std::size_t> leader(ring.size());
    std::iota(leader.begin(), leader.end(), std::size_t{0});
    const auto root = [&](std::size_t a) {
        while (leader[a] != a) a = leader[a];
        return a;
    };
    const auto shared_edge = [](const Corner& p, const Corner& q) -> std::optional<VertexIndex> {
        if (p.before == q.after || p.before == q.before) return p.before;
        if (p.after == q.before || p.after == q.after) return p.after;
        return std::nullopt;
    };
    for (std::size_t a = 0; a < ring.size(); ++a)
        for (std::size_t b = a + 1; b < ring.size(); ++b) {
            const std::optional<VertexIndex> other = shared_edge(ring[a], ring[b]);
            if (!other || mesh.is_crease(v, *other)) continue;
            if (!smooth_between(scene.surfaces[mesh.patches[ring[a].patch].surface],
                                scene.surfaces[mesh.patches[ring[b].patch].surface]))
                continue;
            const auto [low, high] = std::minmax({root(a), root(b)});
            leader[high] = low;
        }
    for (std::size_t a = 0; a < ring.size(); ++a) leader[a] = root(a);
    return leader;
}

/// Patches by vertex: those round vertex v are at [start[v], start[v + 1]).
struct Rings {
    std::vector<std::size_t> start;
    std::vector<Corner> corners;

    explicit Rings(const PatchMesh& mesh) : start(mesh.vertices.size() + 1, 0) {
        for_each_corner(mesh, [&](VertexIndex v, const Corner&) { ++start[v + 1]; });
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) start[v + 1] += start[v];
        corners.resize(start.back());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for_each_corner(mesh,
                        [&](VertexIndex v, const Corner& corner) { corners[next[v]++] = corner; });
    }
    std::span<const Corner> at(VertexIndex v) const {
        return {corners.data() + start[v], start[v + 1] - start[v]};
    }

    template <typename Visit>
    static void for_each_corner(const PatchMesh& mesh, const Visit& visit) {
        for (PatchIndex i = 0; i < mesh.size(); ++i) {
            const Patch& patch = mesh.patches[i];
            const std::size_t n = patch.covered ? 0 : patch.corner_count();
            for (std::size_t k = 0; k < n; ++k)
                visit(patch.vertices[k],
                      Corner{i, k, patch.vertices[(k + n - 1) % n], patch.vertices[(k + 1) % n]});
        }
    }
};

}  // namespace

SmoothGroups find_smooth_groups(const Scene& scene, const PatchMesh& mesh) {
    const Rings rings(mesh);
    SmoothGroups groups;
    groups.of_patch.resize(mesh.size());
    for (VertexIndex v = 0; v < mesh.vertices.size(); ++v) {
        const std::span<const Corner> ring = rings.at(v);
        const std::vector<std::size_t> leader = group_ring(scene, mesh, v, ring);
        std::vector<std::size_t> number(ring.size());
        for (std::size_t a = 0; a < ring.size(); ++a) {
            if (leader[a] == a) {
                number[a] = groups.corners.size();
                groups.corners.push_back({v, {}});
            }
            const std::size_t g = number[a] = number[leader[a]];
            groups.corners[g].patches.push_back(ring[a].patch);
            groups.of_patch[ring[a].patch][ring[a].corner] = static_cast<std::uint32_t>(g);
        }
    }
    for (PatchIndex i = 0; i < mesh.size(); ++i)
        if (mesh.patches[i].is_triangle()) groups.of_patch[i][3] = groups.of_patch[i][2];
    return groups;
}

}  // namespace patchlight
