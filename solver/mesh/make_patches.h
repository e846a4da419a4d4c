#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/contact_lines.h"
#include "solver/scene/coplanar.h"

#include <functional>

namespace patchlight {

/// Longest patch edge that cuts the scene into about so many patches [m].
double patch_size_for(const Scene& scene, double patches);

/// About how many patches `make_patches` will make; allocates nothing of their number.
std::size_t estimate_patch_count(const Scene& scene, double patch_size, bool cut_slivers = true);

/// What the patches of a surface must respect.
struct MeshLines {
    CoplanarOverlaps overlaps;
    std::vector<std::vector<Segment>> creases;  // per surface: contact lines and outlines of covers
    std::vector<bool> hidden;                   // surfaces that are covered wholly
    bool cut_slivers = true;                    // across, to a length of about 8 widths
};
/// `go_on` is asked now and then; after a false the lines are not all there.
MeshLines find_mesh_lines(const Scene& scene, const std::function<bool()>& go_on = {});

/// Adds outlines of narrow gaps to the creases, but for those that are as good as there: within
/// half their height above the surface.
void add_gap_lines(const Scene& scene, MeshLines& lines);

/// None: polygons as they are, without regard for one another.
MeshLines no_lines(const Scene& scene);

/// Cuts every surface into quads and triangles with no edge longer than `patch_size` [m].
/// Vertices are shared: there are no T-vertices within a surface, nor along edges that two surfaces
/// share whole. Areas of the patches of a surface sum to its own to rounding. Slivers, where they
/// are cut, come to 256 parts at most. Outlines of coplanar polygons that
/// cover a surface become edges of its patches, and what lies beneath is marked `covered`; so do
/// lines along which other surfaces rest on it or pass through it.
/// `go_on` is asked now and then with the number of patches so far; after a false they are not all
/// there, and of no use.
PatchMesh make_patches(const Scene& scene, const MeshLines& lines, double patch_size,
                       const std::function<bool(std::size_t)>& go_on = {});

/// Polygons as they are given, for where there is no time to cut them.
PatchMesh uncut_patches(const Scene& scene);

/// Corners of a patch, 3 or 4 [m].
std::vector<Vec3> patch_corners(const PatchMesh& mesh, PatchIndex i);

}  // namespace patchlight
