#pragma once

#include "solver/scene/light.h"

#include <array>
#include <cstddef>
#include <span>

namespace patchlight {

/// A small convex polygon without heap: a patch, or what is left of it after clipping.
struct ConvexPolygon {
    static constexpr std::size_t most_corners = 8;
    std::array<Vec3, most_corners> corners;  // counter-clockwise from the front [m]
    std::size_t size = 0;

    void add(const Vec3& p) {
        if (size < most_corners) corners[size++] = p;
    }
    std::span<const Vec3> view() const { return {corners.data(), size}; }
};

/// The part of a polygon in front of the plane through `point` with unit normal `normal`
/// (Sutherland & Hodgman, 1974).
ConvexPolygon clip_to_front(const ConvexPolygon& polygon, const Vec3& point, const Vec3& normal);

}  // namespace patchlight
