#pragma once

#include <Eigen/Core>
#include <array>

namespace patchlight::raster {

/// A corner before the division by w.
struct ClipVertex {
    Eigen::Vector4d position = Eigen::Vector4d::Zero();  // in the canonical volume's space
    Eigen::Array3d colour = Eigen::Array3d::Zero();      // linear radiance
};

/// A convex polygon. Each plane adds one corner, so 9 do in exact arithmetic; the room is for half
/// as many again at each of the six planes, which no rounding can exceed.
struct ClipPolygon {
    std::array<ClipVertex, 28> corners;
    int size = 0;
};

/// One bit for each plane of the canonical volume (|x| <= w, |y| <= w, 0 <= z <= w) that the
/// point is outside of; 0 means inside.
unsigned planes_outside(const Eigen::Vector4d& position);

/// The part of a triangle inside the canonical volume, colours interpolated along; size 0 if there
/// is none. Two triangles that share an edge get the same corners on it, bit for bit.
/// Sutherland & Hodgman, "Reentrant Polygon Clipping", 1974, in homogeneous coordinates.
ClipPolygon clip(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c);

}  // namespace patchlight::raster
