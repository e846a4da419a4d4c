#include "solver/display/aperture.h"

#include <Eigen/Geometry>

namespace patchlight {

namespace {
constexpr float nearest_line = 1e-6f;  // of its size: a distance that is taken for no less [1]
}

Aperture make_aperture(const RayPoint& corner, const RayPoint& first_edge,
                       const RayPoint& second_edge) {
    Aperture aperture;
    aperture.corner = corner;
    aperture.first_edge = first_edge;
    aperture.second_edge = second_edge;
    aperture.normal = first_edge.cross(second_edge);
    aperture.area = aperture.normal.norm();
    aperture.normal /= aperture.area;
    aperture.first_of = first_edge / first_edge.squaredNorm();
    aperture.second_of = second_edge / second_edge.squaredNorm();
    return aperture;
}

Aperture::Pick Aperture::pick_from(const RayPoint& origin, float u, float v) const {
    const float first = first_edge.norm(), second = second_edge.norm();
    const bool first_is_longer = first > second;
    const RayPoint &along = first_is_longer ? first_edge : second_edge,
                   &across = first_is_longer ? second_edge : first_edge;
    const float length = std::max(first, second), width = std::min(first, second);
    const RayPoint unit = along / length, start = corner + v * across;
    const float foot = (origin - start).dot(unit);
    const float distance =
        std::max((origin - start - foot * unit).norm(), nearest_line * (width + length));
    const float low = std::atan(-foot / distance), high = std::atan((length - foot) / distance);
    const float t = std::clamp(distance * std::tan(low + u * (high - low)), -foot, length - foot);
    return {start + (foot + t) * unit,
            width * (high - low) * (distance * distance + t * t) / distance};
}

}  // namespace patchlight
