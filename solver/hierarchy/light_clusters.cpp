#include "solver/hierarchy/light_clusters.h"

#include "solver/hierarchy/alike_parts.h"

#include <algorithm>

namespace patchlight {

LightClusters make_light_clusters(const Scene& scene, const PatchMesh& mesh, std::size_t most) {
    LightClusters clusters;
    std::vector<PatchIndex> seen;
    std::vector<FacingPlace> places;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        seen.push_back(i);
        places.push_back({patch.centre, scene.surfaces[patch.surface].normal, patch.area});
    }
    AlikeParts parts(places);
    clusters.of_patch.assign(mesh.size(), 0);
    for (const AlikeParts::Part& part : parts.cut(most)) {
        double area = 0.0;
        const std::span<std::uint32_t> members = parts.places(part);
        std::sort(members.begin(), members.end());
        for (const std::uint32_t k : members) {
            clusters.of_patch[seen[k]] = static_cast<std::uint32_t>(clusters.size());
            clusters.patches.push_back(seen[k]);
            area += mesh.patches[seen[k]].area;
        }
        clusters.first.push_back(part.first);
        clusters.area.push_back(area);
    }
    clusters.first.push_back(seen.size());
    return clusters;
}

}  // namespace patchlight
