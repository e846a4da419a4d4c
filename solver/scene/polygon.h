#pragma once

#include "solver/scene/light.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace patchlight {

using Vec2 = Eigen::Vector2d;

/// Half the sum of cross products of successive corners: length is the area, direction the normal
/// of the side from which corners run counter-clockwise (Newell) [m²].
Vec3 vector_area(std::span<const Vec3> corners);

/// Area centroid of a planar polygon with unit normal `normal` [m].
Vec3 centroid(std::span<const Vec3> corners, const Vec3& normal);

/// Coordinates in a plane: x = (p - origin)·u, y = (p - origin)·v, with u × v = normal.
struct PlaneFrame {
    Vec3 origin = Vec3::Zero();
    Vec3 u = Vec3::UnitX();
    Vec3 v = Vec3::UnitY();
    Vec3 normal = Vec3::UnitZ();

    Vec2 flat(const Vec3& p) const { return {(p - origin).dot(u), (p - origin).dot(v)}; }
    Vec3 lift(const Vec2& q) const { return origin + q.x() * u + q.y() * v; }
};
PlaneFrame frame_of(const Vec3& origin, const Vec3& unit_normal);
/// The same with x along an edge, so that it turns with the scene; as frame_of where that has no
/// length in the plane.
PlaneFrame frame_along(const Vec3& origin, const Vec3& edge, const Vec3& unit_normal);
/// Of a polygon: from its first corner along its first edge.
PlaneFrame frame_along(std::span<const Vec3> corners, const Vec3& unit_normal);

/// Twice the signed area of the triangle a, b, c: positive if counter-clockwise.
inline double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Signed area of a polygon: positive if counter-clockwise [m²].
double signed_area(std::span<const Vec2> polygon);

/// Cuts a simple counter-clockwise polygon into triangles by clipping ears, best-shaped first
/// (Meisters, "Polygons have ears", 1975). Fewer than n - 2 triangles: the polygon is not simple.
std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec2> polygon);

/// Corners of the convex hull of points near a plane, seen from its front, counter-clockwise;
/// the points themselves, not their projections. Andrew's monotone chain (1979).
std::vector<Vec3> convex_hull(std::span<const Vec3> points, const PlaneFrame& frame);

/// Whether two edges that are not neighbours touch or cross.
bool crosses_itself(std::span<const Vec2> polygon);

/// Whether q lies in the closed polygon (even-odd rule).
bool contains(std::span<const Vec2> polygon, const Vec2& q);

}  // namespace patchlight
