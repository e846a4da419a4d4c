#pragma once

#include "solver/form_factors/convex_polygon.h"

namespace patchlight {

/// Share of the light leaving a surface element at `point` with unit normal `normal` that reaches
/// the polygon's front, nothing between [1]. 0 if the point is behind the polygon's plane; what of
/// the polygon is behind the element's own plane is clipped.
/// Lambert, "Photometria", 1760; Hottel & Sarofim, "Radiative Transfer", 1967.
double point_factor(const Vec3& point, const Vec3& normal, const ConvexPolygon& polygon,
                    const Vec3& polygon_normal);

}  // namespace patchlight
