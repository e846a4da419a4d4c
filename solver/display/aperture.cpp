#include "solver/display/aperture.h"

#include <Eigen/Geometry>

namespace patchlight {

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

}  // namespace patchlight
