#pragma once

#include "solver/scene/contact_lines.h"
#include "solver/scene/scene.h"

#include <vector>

namespace patchlight {

/// Outlines of the surfaces that cover surface s, as far as they part what is seen of it from what
/// is not: what of an outline lies under another cover is left out, and a line that two have in
/// common is there once. Of many polygons heaped up on one plane hardly anything is left.
std::vector<Segment> cover_lines(const Scene& scene, SurfaceIndex s,
                                 const std::vector<SurfaceIndex>& covers, double reach);

}  // namespace patchlight
