#pragma once

#include "solver/scene/coplanar.h"
#include "solver/scene/scene.h"

#include <array>
#include <functional>
#include <vector>

namespace patchlight {

using Segment = std::array<Vec3, 2>;  // [m]

/// Whether some of the segment lies inside the outline, off its edges.
bool reaches_inside(const Surface& surface, const Segment& s, double reach);

/// Where other surfaces meet each surface inside its outline (a line may go on beyond it): edges
/// that rest on it (the foot of a box), and cuts of surfaces that pass through it. Light and shadow
/// end sharply there, so patches that straddle such a line would carry them across. Lines along the
/// surface's own edges are left out: there the mesh ends anyway.
/// Nor do surfaces count here that cover it or that it covers. `go_on` is asked now and then; after
/// a false not all are there.
std::vector<std::vector<Segment>> find_contact_lines(const Scene& scene,
                                                     const CoplanarOverlaps& overlaps,
                                                     const std::function<bool()>& go_on = {});

}  // namespace patchlight
