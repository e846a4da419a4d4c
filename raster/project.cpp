#include "raster/project.h"

namespace patchlight::raster {

ProjectedVertex project(const Eigen::Vector4d& position, const Viewport& viewport) {
    ProjectedVertex vertex;
    vertex.position = position;
    vertex.planes_outside = planes_outside(position);
    if (vertex.planes_outside == 0)
        if (const auto screen = screen_vertex(position, viewport)) vertex.screen = *screen;
    return vertex;
}

}  // namespace patchlight::raster
