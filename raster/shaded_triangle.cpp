#include "raster/shaded_triangle.h"

namespace patchlight::raster {

std::optional<ShadedTriangle> shaded_triangle(const ScreenCorner& a, const ScreenCorner& b,
                                              const ScreenCorner& c) {
    const ScreenVertex& p = a.vertex;
    const ScreenVertex& q = b.vertex;
    const ScreenVertex& r = c.vertex;
    if (turn(p.snapped, q.snapped, r.snapped) >= 0) return std::nullopt;
    const PlaneFit fit(p, q, r);
    ShadedTriangle triangle;
    triangle.corners = {p.snapped, r.snapped, q.snapped};
    triangle.nearness = fit.through(p.nearness, q.nearness, r.nearness);
    triangle.inverse_w = fit.through(p.inverse_w, q.inverse_w, r.inverse_w);
    triangle.farthest = static_cast<float>(std::min({p.nearness, q.nearness, r.nearness}));
    triangle.nearest = static_cast<float>(std::max({p.nearness, q.nearness, r.nearness}));
    const Eigen::Array3d low = a.colour.min(b.colour).min(c.colour);
    const Eigen::Array3d high = a.colour.max(b.colour).max(c.colour);
    for (int channel = 0; channel < 3; ++channel) {
        const auto at = static_cast<std::size_t>(channel);
        triangle.colour_over_w[at] =
            fit.through(a.colour[channel] * p.inverse_w, b.colour[channel] * q.inverse_w,
                        c.colour[channel] * r.inverse_w);
        triangle.darkest[at] = static_cast<float>(low[channel]);
        triangle.brightest[at] = static_cast<float>(high[channel]);
    }
    return triangle;
}

}  // namespace patchlight::raster
