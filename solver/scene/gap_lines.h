#pragma once

#include "solver/scene/contact_lines.h"

namespace patchlight {

/// Part of an outline that lies close in front of a surface, as it is projected on that.
struct GapLine {
    Segment at;
    double height = 0.0;  // of the outline above the surface [m]
};

/// Outlines of surfaces that face each other across a gap so narrow, for their size, that much of
/// the light between them goes to and fro: a lamp close below its ceiling. Patches that straddle
/// such a line take light out of the gap that stays in it. Each surface's lines, on its plane.
/// Small surfaces are left out, and edges that two of them share.
std::vector<std::vector<GapLine>> find_gap_lines(const Scene& scene);

}  // namespace patchlight
