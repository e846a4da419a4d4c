#include "solver/form_factors/convex_polygon.h"

namespace patchlight {

ConvexPolygon clip_to_front(const ConvexPolygon& polygon, const Vec3& point, const Vec3& normal) {
    ConvexPolygon kept;
    for (std::size_t k = 0; k < polygon.size; ++k) {
        const Vec3 &p = polygon.corners[k], &q = polygon.corners[(k + 1) % polygon.size];
        const double at_p = (p - point).dot(normal), at_q = (q - point).dot(normal);
        if (at_p >= 0.0) kept.add(p);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
            kept.add(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return kept;
}

}  // namespace patchlight
