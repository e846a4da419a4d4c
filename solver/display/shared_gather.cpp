#include "solver/display/vertex_gather.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <unordered_map>

namespace patchlight {

namespace {

constexpr double same_normal = 1.0 - 1e-12;
constexpr double towards_centres = 1e-4;  // of the way to the middle of the patches' centres

std::uint64_t place_key(const Vec3& p) {
    std::uint64_t key = 0;
    for (int d = 0; d < 3; ++d) key = mix(key, std::bit_cast<std::uint64_t>(p[d]));
    return key;
}

}  // namespace

/// In the order of their first members; each of them faces as the first of its group does.
std::vector<VertexGather::Shared> VertexGather::shared(
    const RefinementTree& tree, std::span<const std::uint32_t> vertices) const {
    std::vector<Shared> groups;
    const auto normal = [&](std::uint32_t k) -> const Vec3& {
        return scene_.surfaces[surface_of(tree.vertices()[vertices[k]].patch)].normal;
    };
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> groups_at;
    for (std::uint32_t k = 0; k < vertices.size(); ++k) {
        if (least_cosine_ > 1.0) {
            groups.push_back({k});
            continue;
        }
        const Vec3& position = tree.vertices()[vertices[k]].position;
        std::vector<std::uint32_t>& here = groups_at[place_key(position)];
        const auto fits = std::ranges::find_if(here, [&](std::uint32_t g) {
            const std::uint32_t first = groups[g].front();
            const bool same_plane = std::ranges::any_of(groups[g], [&](std::uint32_t member) {
                return normal(member).dot(normal(k)) > same_normal;  // a crease is between
            });
            return !same_plane && normal(first).dot(normal(k)) >= least_cosine_ &&
                   tree.vertices()[vertices[first]].position == position;
        });
        if (fits != here.end()) {
            groups[*fits].push_back(k);
            continue;
        }
        here.push_back(static_cast<std::uint32_t>(groups.size()));
        groups.push_back({k});
    }
    return groups;
}

/// Above all surfaces of the group, and a little towards their middle so that no ray starts on the
/// edge of another.
GatherPoint VertexGather::shared_point(const RefinementTree& tree,
                                       std::span<const std::uint32_t> vertices, const Shared& group,
                                       std::vector<Vec3>& normals) const {
    Vec3 mean = Vec3::Zero(), inwards = Vec3::Zero();
    const Vec3& position = tree.vertices()[vertices[group.front()]].position;
    float lift = 0.0f;
    for (const std::uint32_t k : group) {
        const PatchIndex i = tree.vertices()[vertices[k]].patch;
        normals.push_back(scene_.surfaces[surface_of(i)].normal);
        mean += normals.back();
        inwards += mesh_.patches[i].centre - position;
        lift = std::max(lift, rays_.lift(surface_of(i)));
    }
    mean.normalize();
    inwards *= towards_centres / static_cast<double>(group.size());
    inwards -= inwards.dot(mean) * mean;
    double raised = 0.0;  // where surfaces rise towards their middle
    for (const Vec3& normal : normals)
        raised = std::max(raised, -inwards.dot(normal) / std::max(0.5, normal.dot(mean)));
    return gather_.at(position + inwards + raised * mean, mean, lift,
                      rays_.frame(surface_of(tree.vertices()[vertices[group.front()]].patch)));
}

}  // namespace patchlight
