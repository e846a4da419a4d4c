#pragma once

#include "solver/form_factors/convex_polygon.h"

namespace patchlight {

/// A_p F_pq = A_q F_qp of two polygons that lie wholly in front of each other, nothing between
/// [m²]. Stokes' double contour integral of ln r over both outlines, the inner edge in closed form,
/// the outer by quadrature that is graded towards points where the edges meet or nearly do;
/// relative error about 1e-9 also for polygons that share an edge or almost touch, 5e-8 for
/// needles. Sparrow, "A New and Simpler Formulation for Radiative Angle Factors", 1963.
double contour_exchange(const ConvexPolygon& p, const ConvexPolygon& q);

}  // namespace patchlight
