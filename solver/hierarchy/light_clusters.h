#pragma once

#include "solver/mesh/patch_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patchlight {

constexpr std::size_t most_clusters = 20'000;  // of a scene

/// Patches that carry light together: they lie close by and face alike. Piecewise constant
/// radiosity on unions of polygons keeps reciprocity, closure and the solvers as they stand, so
/// that thousands of clusters serve any number of triangles (face clusters: Willmott, Heckbert &
/// Garland, "Face Cluster Radiosity", 1999).
struct LightClusters {
    std::vector<std::uint32_t> of_patch;  // number of its cluster; of covered patches any
    std::vector<PatchIndex> patches;      // by clusters; covered ones are left out
    std::vector<std::size_t> first;       // in `patches`, per cluster, and one more
    std::vector<double> area;             // per cluster [m²]

    std::size_t size() const { return area.size(); }
    std::span<const PatchIndex> members(std::size_t c) const {
        return std::span(patches).subspan(first[c], first[c + 1] - first[c]);
    }
};

/// Cuts all patches into `most` clusters, or fewer where there are fewer patches: always the one
/// in two whose light is most likely to differ within, which grows with its area, its width and
/// how much its normals differ.
LightClusters make_light_clusters(const Scene& scene, const PatchMesh& mesh, std::size_t most);

}  // namespace patchlight
