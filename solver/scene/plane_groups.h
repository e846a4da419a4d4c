#pragma once

#include "solver/scene/scene.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// Surfaces that face one way in one plane, to within half the local tolerance. A wall that comes
/// as a thousand quads is one group. Groups are numbered as their first surfaces come.
struct PlaneGroups {
    std::vector<std::uint32_t> of_surface;
    std::vector<std::vector<SurfaceIndex>> members;  // per group, ascending; the first gives the
                                                     // plane
    static constexpr std::uint32_t none = ~0u;
    std::vector<std::uint32_t> other_side;  // per group: that of the other halves of its two-sided
                                            // polygons, or none
    std::size_t size() const { return members.size(); }
};

PlaneGroups find_plane_groups(const Scene& scene);

}  // namespace patchlight
