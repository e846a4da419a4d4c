#include "solver/display/smooth_groups.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr double crease_cosine = 0.98480775301220802;  // of 10 degrees: more is a crease

bool smooth_between(const Surface& a, const Surface& b) {
    return a.object == b.object && a.material == b.material && a.side == b.side &&
           a.normal.dot(b.normal) >= crease_cosine;
}

}  // namespace

SmoothGroups find_smooth_groups(const Scene& scene, const PatchMesh& mesh) {
    std::vector<std::size_t> start(mesh.vertices.size() + 1, 0);
    const auto for_each_corner = [&](const auto& visit) {
        for (PatchIndex i = 0; i < mesh.size(); ++i)
            for (std::size_t k = 0; k < mesh.patches[i].corner_count() && !mesh.patches[i].covered;
                 ++k)
                visit(i, k);
    };
    for_each_corner([&](PatchIndex i, std::size_t k) { ++start[mesh.patches[i].vertices[k] + 1]; });
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) start[v + 1] += start[v];
    std::vector<std::pair<PatchIndex, std::size_t>> around(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for_each_corner([&](PatchIndex i, std::size_t k) {
        around[next[mesh.patches[i].vertices[k]]++] = {i, k};
    });

    SmoothGroups groups;
    groups.of_patch.resize(mesh.size());
    for (VertexIndex v = 0; v < mesh.vertices.size(); ++v) {
        const std::size_t first_group = groups.corners.size();
        for (std::size_t at = start[v]; at < start[v + 1]; ++at) {
            const auto [i, k] = around[at];
            const Surface& surface = scene.surfaces[mesh.patches[i].surface];
            std::size_t g = first_group;
            while (g < groups.corners.size() &&
                   !smooth_between(
                       surface,
                       scene.surfaces[mesh.patches[groups.corners[g].patches.front()].surface]))
                ++g;
            if (g == groups.corners.size()) groups.corners.push_back({v, {}});
            groups.corners[g].patches.push_back(i);
            groups.of_patch[i][k] = static_cast<std::uint32_t>(g);
        }
    }
    for (PatchIndex i = 0; i < mesh.size(); ++i)
        if (mesh.patches[i].is_triangle()) groups.of_patch[i][3] = groups.of_patch[i][2];
    return groups;
}

}  // namespace patchlight
