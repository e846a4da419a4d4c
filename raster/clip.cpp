#include "raster/clip.h"

namespace patchlight::raster {
namespace {

constexpr int plane_count = 6;

/// Positive inside. The near plane comes first: past it w is positive.
double height_above(int plane, const Eigen::Vector4d& p) {
    switch (plane) {
        case 0:
            return p.w() - p.z();
        case 1:
            return p.z();
        case 2:
            return p.w() + p.x();
        case 3:
            return p.w() - p.x();
        case 4:
            return p.w() + p.y();
        default:
            return p.w() - p.y();
    }
}

/// Always from the inside out, so that both neighbours of an edge compute the same corner.
ClipVertex crossing(const ClipVertex& inside, double above, const ClipVertex& outside,
                    double below) {
    const double share = above / (above - below);
    ClipVertex corner;
    corner.position = inside.position + share * (outside.position - inside.position);
    corner.colour = inside.colour + share * (outside.colour - inside.colour);
    return corner;
}

ClipPolygon clip_against(int plane, const ClipPolygon& polygon) {
    ClipPolygon kept;
    for (int i = 0; i < polygon.size; ++i) {
        const ClipVertex& from = polygon.corners[static_cast<std::size_t>(i)];
        const ClipVertex& to = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.size)];
        const double from_height = height_above(plane, from.position);
        const double to_height = height_above(plane, to.position);
        const bool from_inside = from_height >= 0.0;
        const bool to_inside = to_height >= 0.0;
        if (from_inside) kept.corners[static_cast<std::size_t>(kept.size++)] = from;
        if (from_inside == to_inside) continue;
        kept.corners[static_cast<std::size_t>(kept.size++)] =
            from_inside ? crossing(from, from_height, to, to_height)
                        : crossing(to, to_height, from, from_height);
    }
    return kept;
}

}  // namespace

unsigned planes_outside(const Eigen::Vector4d& position) {
    unsigned bits = 0;
    for (int plane = 0; plane < plane_count; ++plane)
        bits |= (height_above(plane, position) >= 0.0 ? 0U : 1U) << plane;
    return bits;
}

ClipPolygon clip(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
    ClipPolygon polygon;
    polygon.corners[0] = a;
    polygon.corners[1] = b;
    polygon.corners[2] = c;
    polygon.size = 3;
    const unsigned crossed =
        planes_outside(a.position) | planes_outside(b.position) | planes_outside(c.position);
    for (int plane = 0; plane < plane_count && polygon.size >= 3; ++plane)
        if (crossed >> plane & 1U) polygon = clip_against(plane, polygon);
    if (polygon.size < 3) polygon.size = 0;
    return polygon;
}

}  // namespace patchlight::raster
