#include "solver/findings/surface_edges.h"

#include "solver/mesh/welder.h"
#include "solver/scene/local_tolerance.h"

#include <algorithm>
#include <tuple>

namespace patchlight {

SurfaceEdges find_surface_edges(const Scene& scene) {
    SurfaceEdges found;
    const LocalTolerance tolerance(scene);
    std::vector<double> reach;
    for (std::size_t f = 0; f < tolerance.frames().size(); ++f)
        reach.push_back(tolerance.at_point(static_cast<FrameIndex>(f)));
    Welder welder(std::move(reach));
    std::vector<SurfaceEdge> sides;
    std::vector<std::uint32_t> numbers;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        if (surface.side == Side::back) continue;
        numbers.clear();
        for (const Vec3& p : surface.corners)
            numbers.push_back(welder.add(p, tolerance.frame_of(s)));
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            const std::uint32_t a = numbers[k], b = numbers[(k + 1) % numbers.size()];
            if (a != b) sides.push_back({{std::min(a, b), std::max(a, b)}, {s, s}, 1});
        }
    }
    found.vertices = welder.take_points();
    std::sort(sides.begin(), sides.end(), [](const SurfaceEdge& a, const SurfaceEdge& b) {
        return std::tie(a.ends, a.surfaces) < std::tie(b.ends, b.surfaces);
    });
    for (const SurfaceEdge& side : sides) {
        if (found.edges.empty() || found.edges.back().ends != side.ends) {
            found.edges.push_back(side);
            continue;
        }
        SurfaceEdge& edge = found.edges.back();
        if (++edge.uses == 2) edge.surfaces[1] = side.surfaces[0];
    }
    return found;
}

}  // namespace patchlight
