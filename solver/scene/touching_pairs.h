#pragma once

#include "solver/scene/scene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>
#include <vector>

namespace patchlight {

/// Calls visit(a, b), a < b, for surfaces whose boxes, widened by `reach`, intersect: a sweep along
/// x.
template <typename Visit>
void for_each_touching_pair(const Scene& scene, double reach, const Visit& visit) {
    const std::size_t n = scene.surfaces.size();
    std::vector<Eigen::AlignedBox3d> boxes(n);
    std::vector<SurfaceIndex> order(n);
    for (SurfaceIndex s = 0; s < n; ++s) {
        for (const Vec3& p : scene.surfaces[s].corners) boxes[s].extend(p);
        boxes[s].min().array() -= reach;
        boxes[s].max().array() += reach;
        order[s] = s;
    }
    std::sort(order.begin(), order.end(), [&](SurfaceIndex a, SurfaceIndex b) {
        return std::pair(boxes[a].min().x(), a) < std::pair(boxes[b].min().x(), b);
    });
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t l = k + 1; l < n && boxes[order[l]].min().x() <= boxes[order[k]].max().x();
             ++l)
            if (boxes[order[k]].intersects(boxes[order[l]]))
                visit(std::min(order[k], order[l]), std::max(order[k], order[l]));
}

}  // namespace patchlight
