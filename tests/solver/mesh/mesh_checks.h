#pragma once

#include "tests/solver/scenes.h"

#include <set>
#include <string>

namespace patchlight {

/// Each returns a measure of what is wrong; 0, or within rounding of it, is right.

/// Largest |Σ patch areas − area| / area over surfaces [1].
double area_error(const CutScene& cut);
/// Longest patch edge over the patch size asked for [1].
double longest_edge(const CutScene& cut);
/// Least sine of a patch's corner: above 0 for convex, counter-clockwise patches [1].
double least_sine(const CutScene& cut);
/// Largest length over width of a patch: longest edge squared over area [1].
double worst_aspect(const CutScene& cut);
/// Distance of the patch's vertices from its surface's plane, over the surface's size [1].
double worst_height(const CutScene& cut);

/// Edges of patches of surface s that no other patch of it shares: its outline, if there are no
/// T-vertices. Their total length over the outline's, minus 1; also the number of edges that more
/// than two patches, or two patches in the same direction, have.
double excess_outline(const CutScene& cut, SurfaceIndex s);
std::size_t edges_shared_wrongly(const CutScene& cut, SurfaceIndex s);

/// Numbers of the vertices of surface s that lie on the segment.
std::set<VertexIndex> vertices_along(const CutScene& cut, SurfaceIndex s, const Vec3& a,
                                     const Vec3& b);
/// Pairs of surfaces that share a whole edge but not its vertices, as text; empty if all is well.
std::string edges_not_shared(const CutScene& cut);

/// Of `count` random points on surface s, those in no patch or in several.
int points_not_in_one_patch(const CutScene& cut, SurfaceIndex s, int count, unsigned seed);

/// Area of surface s that is covered [m²].
double covered_area(const CutScene& cut, SurfaceIndex s);
/// Patches of surface s that its contact lines cut through.
int patches_cut_by_contacts(const CutScene& cut, SurfaceIndex s);

}  // namespace patchlight
