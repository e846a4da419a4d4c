#pragma once

#include "solver/scene/local_tolerance.h"
#include "solver/scene/scene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace patchlight {

/// Calls visit(a, b), a < b, for surfaces whose boxes, widened by their tolerances, intersect: a
/// sweep along x. `go_on` is asked now and then; after a false no more are visited.
template <typename Visit>
void for_each_touching_pair(const Scene& scene, const LocalTolerance& tolerance,
                            const std::function<bool()>& go_on, const Visit& visit) {
    const std::size_t n = scene.surfaces.size();
    std::vector<Eigen::AlignedBox3d> boxes(n);
    std::vector<SurfaceIndex> order(n);
    for (SurfaceIndex s = 0; s < n; ++s) {
        for (const Vec3& p : scene.surfaces[s].corners) boxes[s].extend(p);
        boxes[s].min().array() -= tolerance.at(s);
        boxes[s].max().array() += tolerance.at(s);
        order[s] = s;
    }
    std::sort(order.begin(), order.end(), [&](SurfaceIndex a, SurfaceIndex b) {
        return std::pair(boxes[a].min().x(), a) < std::pair(boxes[b].min().x(), b);
    });
    constexpr std::size_t at_a_time = 4096;  // pairs of boxes: less than a millisecond
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = k + 1; l < n && boxes[order[l]].min().x() <= boxes[order[k]].max().x();
             ++l) {
            if (++pairs % at_a_time == 0 && go_on && !go_on()) return;
            if (boxes[order[k]].intersects(boxes[order[l]]))
                visit(std::min(order[k], order[l]), std::max(order[k], order[l]));
        }
}

}  // namespace patchlight
