#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/plane_groups.h"
#include "solver/scene/polygon.h"

#include <span>
#include <vector>

namespace patchlight {

/// Neighbouring patches of one plane, some sixteen together, and the points whose convex hull
/// holds them. Clusters of a plane group follow one another, and groups ascend.
struct PatchClusters {
    std::vector<std::uint32_t> of_patch;
    std::vector<std::uint32_t> group;      // plane group, per cluster
    std::vector<std::size_t> first_point;  // per cluster, and one more
    std::vector<Vec3> hull_points;         // [m]

    std::size_t size() const { return group.size(); }
    std::span<const Vec3> points(std::size_t c) const {
        return std::span(hull_points).subspan(first_point[c], first_point[c + 1] - first_point[c]);
    }
};

PatchClusters make_clusters(const Scene& scene, const PatchMesh& mesh, const PlaneGroups& groups);

}  // namespace patchlight
