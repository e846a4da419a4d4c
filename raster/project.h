#pragma once

#include "raster/clip.h"
#include "raster/screen.h"

namespace patchlight::raster {

/// A vertex of a mesh seen by a camera.
struct ProjectedVertex {
    Eigen::Vector4d position = Eigen::Vector4d::Zero();  // in the canonical volume's space
    ScreenVertex screen;                                 // only if planes_outside is 0
    unsigned planes_outside = 0;                         // as planes_outside(position)
};

ProjectedVertex project(const Eigen::Vector4d& position, const Viewport& viewport);

/// A corner of a triangle that lies on the screen as a whole.
struct ScreenCorner {
    ScreenVertex vertex;
    Eigen::Array3d colour = Eigen::Array3d::Zero();  // linear radiance
};

/// Calls emit(a, b, c) for the triangles that the visible part of a triangle falls into; turning
/// direction and shared edges are kept.
template <class Emit>
void clip_to_screen(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c,
                    const Viewport& viewport, Emit&& emit) {
    const ClipPolygon polygon = clip(a, b, c);
    std::array<ScreenCorner, std::tuple_size_v<decltype(polygon.corners)>> corners;
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.size); ++i) {
        const auto vertex = screen_vertex(polygon.corners[i].position, viewport);
        if (!vertex) return;
        corners[i] = {*vertex, polygon.corners[i].colour};
    }
    for (std::size_t i = 2; i < static_cast<std::size_t>(polygon.size); ++i)
        emit(corners[0], corners[i - 1], corners[i]);
}

}  // namespace patchlight::raster
