#include "solver/form_factors/patch_clusters.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace patchlight {

namespace {

constexpr std::size_t largest = 16;  // patches in a cluster

struct Clusterer {
    const Scene& scene;
    const PatchMesh& mesh;
    PatchClusters clusters;

    void close(std::span<const PatchIndex> patches) {
        const auto number = static_cast<std::uint32_t>(clusters.surface.size());
        const SurfaceIndex s = mesh.patches[patches[0]].surface;
        clusters.surface.push_back(s);
        clusters.first_point.push_back(clusters.hull_points.size());
        std::vector<VertexIndex> vertices;
        for (const PatchIndex i : patches) {
            clusters.of_patch[i] = number;
            vertices.insert(vertices.end(), mesh.patches[i].vertices.begin(),
                            mesh.patches[i].vertices.end());
        }
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        add_hull(vertices, frame_of(scene.surfaces[s].corners[0], scene.surfaces[s].normal));
    }

    /// Convex hull in the plane by Andrew's monotone chain (1979).
    void add_hull(const std::vector<VertexIndex>& vertices, const PlaneFrame& frame) {
        std::vector<std::pair<Vec2, VertexIndex>> points;
        for (const VertexIndex v : vertices) points.emplace_back(frame.flat(mesh.vertices[v]), v);
        std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
            return std::pair(a.first.x(), a.first.y()) < std::pair(b.first.x(), b.first.y());
        });
        const auto half = [&](auto begin, auto end) {
            std::vector<std::pair<Vec2, VertexIndex>> chain;
            for (auto at = begin; at != end; ++at) {
                while (chain.size() >= 2 &&
                       turn(chain[chain.size() - 2].first, chain.back().first, at->first) <= 0.0)
                    chain.pop_back();
                chain.push_back(*at);
            }
            for (std::size_t k = 0; k + 1 < chain.size(); ++k)
                clusters.hull_points.push_back(mesh.vertices[chain[k].second]);
        };
        half(points.begin(), points.end());
        half(points.rbegin(), points.rend());
    }

    /// Halves the patches across their longer extent until they are few enough.
    void split(std::span<PatchIndex> patches, const PlaneFrame& frame) {
        if (patches.size() <= largest) {
            close(patches);
            return;
        }
        Eigen::AlignedBox2d box;
        for (const PatchIndex i : patches) box.extend(frame.flat(mesh.patches[i].centre));
        const int axis = box.sizes().x() >= box.sizes().y() ? 0 : 1;
        const auto middle = patches.begin() + static_cast<std::ptrdiff_t>(patches.size() / 2);
        std::nth_element(patches.begin(), middle, patches.end(), [&](PatchIndex a, PatchIndex b) {
            const double at_a = frame.flat(mesh.patches[a].centre)[axis],
                         at_b = frame.flat(mesh.patches[b].centre)[axis];
            return at_a != at_b ? at_a < at_b : a < b;
        });
        split(patches.first(patches.size() / 2), frame);
        split(patches.subspan(patches.size() / 2), frame);
    }
};

}  // namespace

PatchClusters make_clusters(const Scene& scene, const PatchMesh& mesh) {
    Clusterer clusterer{scene, mesh, {}};
    clusterer.clusters.of_patch.resize(mesh.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        std::vector<PatchIndex> patches(mesh.first_of_surface[s + 1] - mesh.first_of_surface[s]);
        std::iota(patches.begin(), patches.end(), mesh.first_of_surface[s]);
        if (!patches.empty())
            clusterer.split(patches,
                            frame_of(scene.surfaces[s].corners[0], scene.surfaces[s].normal));
    }
    clusterer.clusters.first_point.push_back(clusterer.clusters.hull_points.size());
    return std::move(clusterer.clusters);
}

}  // namespace patchlight
