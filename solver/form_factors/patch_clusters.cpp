#include "solver/form_factors/patch_clusters.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t largest = 16;           // patches in a cluster
constexpr double same_row = 1.2360679775e-7;  // of an extent; rows are no multiples of it

struct Clusterer {
    const PatchMesh& mesh;
    PatchClusters clusters;

    void close(std::span<const PatchIndex> patches, std::uint32_t group, const PlaneFrame& frame) {
        const auto number = static_cast<std::uint32_t>(clusters.size());
        clusters.group.push_back(group);
        clusters.first_point.push_back(clusters.hull_points.size());
        std::vector<Vec3> points;
        for (const PatchIndex i : patches) {
            clusters.of_patch[i] = number;
            for (const VertexIndex v : mesh.patches[i].vertices) points.push_back(mesh.vertices[v]);
        }
        for (const Vec3& p : convex_hull(points, frame)) clusters.hull_points.push_back(p);
    }

    /// Halves the patches across their longer extent until they are few enough.
    void split(std::span<PatchIndex> patches, std::uint32_t group, const PlaneFrame& frame) {
        if (patches.size() <= largest) {
            close(patches, group, frame);
            return;
        }
        Eigen::AlignedBox2d box;
        for (const PatchIndex i : patches) box.extend(frame.flat(mesh.patches[i].centre));
        // Whatever rounding makes of it: x where both are alike, and those of one row by number.
        const double step = same_row * box.sizes().maxCoeff() + 1e-300;
        const int axis = box.sizes().x() + step >= box.sizes().y() ? 0 : 1;
        const auto row = [&](PatchIndex i) {
            return std::llround(frame.flat(mesh.patches[i].centre)[axis] / step);
        };
        const auto middle = patches.begin() + static_cast<std::ptrdiff_t>(patches.size() / 2);
        std::nth_element(patches.begin(), middle, patches.end(), [&](PatchIndex a, PatchIndex b) {
            const long long at_a = row(a), at_b = row(b);
            return at_a != at_b ? at_a < at_b : a < b;
        });
        split(patches.first(patches.size() / 2), group, frame);
        split(patches.subspan(patches.size() / 2), group, frame);
    }
};

}  // namespace

PatchClusters make_clusters(const Scene& scene, const PatchMesh& mesh, const PlaneGroups& groups) {
    Clusterer clusterer{mesh, {}};
    clusterer.clusters.of_patch.resize(mesh.size());
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
        std::vector<PatchIndex> patches;
        for (const SurfaceIndex s : groups.members[g])
            for (PatchIndex i = mesh.first_of_surface[s]; i < mesh.first_of_surface[s + 1]; ++i)
                patches.push_back(i);
        const Surface& plane = scene.surfaces[groups.members[g][0]];
        if (!patches.empty()) clusterer.split(patches, g, frame_along(plane.corners, plane.normal));
    }
    clusterer.clusters.first_point.push_back(clusterer.clusters.hull_points.size());
    return std::move(clusterer.clusters);
}

}  // namespace patchlight
