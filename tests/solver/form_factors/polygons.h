#pragma once

#include "solver/form_factors/convex_polygon.h"
#include "tests/solver/scenes.h"

namespace patchlight {

ConvexPolygon convex(const Polygon& polygon);
/// A convex polygon of any number of corners as a fan of small ones round its centre.
std::vector<ConvexPolygon> fan(const Polygon& polygon);

/// A polygon of about unit size about the origin, facing somewhere.
Polygon random_facet(std::mt19937& chance, int corners);
/// The same of 3 or 4 corners.
Polygon random_facet(std::mt19937& chance);
Vec3 normal_of(const Polygon& polygon);
/// Whether each lies wholly in front of the other.
bool face_each_other(const Polygon& p, const Polygon& q);

/// A_p F_pq by quadrature of Lambert's formula over p, which is a quad, graded towards its edges:
/// independent of the contour integral. Error about 1e-10 where q is in front of all of p.
double exchange_by_quadrature(const Polygon& p, const Polygon& q);

}  // namespace patchlight
