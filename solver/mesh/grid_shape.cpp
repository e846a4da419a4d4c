#include "solver/mesh/grid_shape.h"

#include <Eigen/Geometry>

#include <array>

#include <cmath>

namespace patchlight {

namespace {
constexpr double largest_ratio = 2.0;  // of opposite edges [1]
constexpr double least_sine = 0.5;     // of a corner's angle: 30 to 150 degrees [1]
}  // namespace

bool fits_a_grid(const Surface& surface) {
    if (surface.corners.size() != 4) return false;
    std::array<Vec3, 4> edges;
    for (std::size_t k = 0; k < 4; ++k)
        edges[k] = surface.corners[(k + 1) % 4] - surface.corners[k];
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 &before = edges[(k + 3) % 4], &after = edges[k];
        const double sine =
            before.cross(after).dot(surface.normal) / (before.norm() * after.norm());
        if (sine < least_sine) return false;
        if (edges[k].norm() > largest_ratio * edges[(k + 2) % 4].norm()) return false;
    }
    return true;
}

double width_of(const Surface& surface) {
    double perimeter = 0.0;
    for (std::size_t k = 0; k < surface.corners.size(); ++k)
        perimeter +=
            (surface.corners[(k + 1) % surface.corners.size()] - surface.corners[k]).norm();
    return 2.0 * surface.area / perimeter;
}

}  // namespace patchlight
