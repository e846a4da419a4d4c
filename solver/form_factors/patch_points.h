#pragma once

#include "solver/form_factors/convex_polygon.h"
#include "solver/mesh/patch_mesh.h"

#include <span>
#include <vector>

namespace patchlight {

/// Gauss points of every patch: order² of them each, a triangle being a quad whose last two corners
/// coincide. The weights of a patch sum to its area [m²].
struct PatchPoints {
    std::size_t per_patch = 0;
    std::vector<double> x, y, z, weight;  // patch i owns [i * per_patch, (i + 1) * per_patch)
};
PatchPoints make_patch_points(const PatchMesh& mesh, int order);

/// A_i F_ij by the product of both patches' Gauss rules, both wholly in front of each other [m²].
double kernel_exchange(const PatchPoints& points, PatchIndex i, const Vec3& normal_i, PatchIndex j,
                       const Vec3& normal_j);

/// The same for two convex polygons, each cut into quads with 3 × 3 Gauss points [m²].
double kernel_exchange(const ConvexPolygon& p, const Vec3& normal_p, const ConvexPolygon& q,
                       const Vec3& normal_q);

}  // namespace patchlight
