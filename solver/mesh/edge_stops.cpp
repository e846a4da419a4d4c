#include "solver/mesh/edge_stops.h"

#include "solver/scene/polygon.h"

namespace patchlight {

Segment snap_to_outline(const Surface& surface, const Segment& crease, double reach) {
    Segment snapped = crease;
    const std::size_t n = surface.corners.size();
    for (Vec3& end : snapped) {
        for (std::size_t k = 0; k < n; ++k) {
            const Vec3 &a = surface.corners[k], &b = surface.corners[(k + 1) % n];
            const Vec3 along = (b - a).normalized();
            const double t = (end - a).dot(along);
            if (t > 0.0 && t < (b - a).norm() && (end - a - t * along).norm() <= reach)
                end = a + t * along;
        }
        for (const Vec3& corner : surface.corners)
            if ((end - corner).norm() <= reach) end = corner;
    }
    return snapped;
}

std::vector<EdgeStop> find_edge_stops(const Surface& surface, std::span<const Segment> creases,
                                      double reach) {
    std::vector<EdgeStop> stops;
    if (creases.empty()) return stops;
    const PlaneFrame frame = frame_along(surface.corners, surface.normal);
    const std::size_t n = surface.corners.size();
    for (std::size_t edge = 0; edge < n; ++edge) {
        const Vec3 &a = surface.corners[edge], &b = surface.corners[(edge + 1) % n];
        const Vec3 along = (b - a).normalized();
        const auto add = [&](const Vec3& p) {
            if ((p - a).norm() > reach && (p - b).norm() > reach) stops.push_back({edge, p});
        };
        for (const Segment& crease : creases) {
            for (const Vec3& end : crease) {
                const double t = (end - a).dot(along);
                if (t > 0.0 && t < (b - a).norm() && (end - a - t * along).norm() <= reach)
                    add(a + t * along);
            }
            const Vec2 p = frame.flat(a), q = frame.flat(b), c = frame.flat(crease[0]),
                       d = frame.flat(crease[1]);
            const double at_c = turn(p, q, c), at_d = turn(p, q, d), at_p = turn(c, d, p),
                         at_q = turn(c, d, q);
            if ((at_c > 0.0) != (at_d > 0.0) && (at_p > 0.0) != (at_q > 0.0))
                add(a + (b - a) * (at_p / (at_p - at_q)));
        }
    }
    return stops;
}

}  // namespace patchlight
