#pragma once

#include "solver/scene/light.h"

#include <array>
#include <span>

namespace patchlight::server {

// Closed forms of view factors, which share nothing with the solver's own.

using Interval = std::array<double, 2>;  // [m]

/// From the rectangle x × y at z = 0 to the rectangle to_x × to_y at z = `distance`, facing it [1].
/// Ehlert & Smith, "View factors for perpendicular and parallel rectangular plates", 1993; no. C-13
/// of Howell, "A Catalog of Radiation Configuration Factors", 1982; C-11 where they are opposed.
double parallel_rectangles(Interval x, Interval y, Interval to_x, Interval to_y, double distance);

/// From the rectangle x × y at z = 0 to the rectangle to_y × to_z at x = 0; `x` and `to_z` begin at
/// 0 or above [1]. Ehlert & Smith, 1993; no. C-15 of Howell, 1982; C-14 with a common edge.
double perpendicular_rectangles(Interval x, Interval y, Interval to_y, Interval to_z);

/// From a surface element to a polygon all of which is above its horizon, and whose front, from
/// which `corners` run counter-clockwise, it sees [1]. Lambert, "Photometria", 1760.
double element_to_polygon(const Vec3& point, const Vec3& normal, std::span<const Vec3> corners);

/// Solid angle of a polygon seen so from a point [sr]: spherical excess, summed over the triangles
/// of a fan. Van Oosterom & Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solid_angle(const Vec3& point, std::span<const Vec3> corners);

}  // namespace patchlight::server
