#include "solver/scene/plane_groups.h"

#include "solver/scene/local_tolerance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace patchlight {

namespace {

constexpr double cell = 1e-3;  // of a normal's components, and of a frame's size, in the index [1]
constexpr double alike = 0.999;  // cosine between normals of one group, at least [1]

using Key = std::array<std::int64_t, 5>;

/// The group's first surface stands for its plane.
bool fits(const Surface& first, const Surface& other, double slack) {
    if (first.normal.dot(other.normal) < alike) return false;
    return std::all_of(other.corners.begin(), other.corners.end(), [&](const Vec3& p) {
        return std::abs((p - first.corners[0]).dot(first.normal)) <= slack;
    });
}

}  // namespace

PlaneGroups find_plane_groups(const Scene& scene) {
    PlaneGroups groups;
    const LocalTolerance tolerance(scene);
    std::vector<std::optional<Vec3>> origins(tolerance.frames().size());  // first corner of each
    std::map<Key, std::vector<std::uint32_t>> index;                      // groups by rounded plane
    groups.of_surface.reserve(scene.surfaces.size());
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        std::optional<Vec3>& origin = origins[tolerance.frame_of(s)];
        if (!origin) origin = surface.corners[0];
        const double level =
            (surface.corners[0] - *origin).dot(surface.normal) / tolerance.frame(s).size();
        const Key key{std::llround(surface.normal.x() / cell),
                      std::llround(surface.normal.y() / cell),
                      std::llround(surface.normal.z() / cell), std::llround(level / cell),
                      tolerance.frame_of(s)};
        std::vector<std::uint32_t>& candidates = index[key];
        const auto found = std::find_if(candidates.begin(), candidates.end(), [&](std::uint32_t g) {
            const SurfaceIndex first = groups.members[g][0];
            return fits(scene.surfaces[first], surface, 0.5 * tolerance.between(first, s));
        });
        if (found != candidates.end()) {
            groups.of_surface.push_back(*found);
            groups.members[*found].push_back(s);
            continue;
        }
        const auto number = static_cast<std::uint32_t>(groups.size());
        candidates.push_back(number);
        groups.of_surface.push_back(number);
        groups.members.push_back({s});
    }
    groups.other_side.assign(groups.size(), PlaneGroups::none);
    for (SurfaceIndex s = 1; s < scene.surfaces.size(); ++s) {
        if (scene.surfaces[s].side != Side::back) continue;  // its front comes right before it
        groups.other_side[groups.of_surface[s]] = groups.of_surface[s - 1];
        groups.other_side[groups.of_surface[s - 1]] = groups.of_surface[s];
    }
    return groups;
}

}  // namespace patchlight
