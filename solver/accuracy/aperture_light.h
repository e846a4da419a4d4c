#pragma once

#include "solver/display/vertex_gather.h"

#include <cstdint>

namespace patchlight {

/// Whether samples of lamps with `effort` would miss more than `noise` of all direct light, by the
/// norm √∫ Y² dA of what is sent back of it, of what comes through apertures: a building has gaps
/// between its columns that add little to what comes by the open sky. Told by points that are alike
/// dense everywhere.
bool apertures_matter(const Scene& scene, const PatchMesh& mesh, const VertexGather& points,
                      const DirectEffort& effort, double noise, std::uint64_t seed);

/// Share of the area where apertures may bring more than `enough` [W/m²].
double lit_by_apertures(const PatchMesh& mesh, const VertexGather& points, double enough);

}  // namespace patchlight
