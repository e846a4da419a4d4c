#pragma once

#include "solver/display/vertex_gather.h"

#include <cstdint>

namespace patchlight {

/// Whether what lamps send through apertures is more than `noise` of all direct light, by the norm
/// √∫ Y² dA of what is sent back of it: a building has gaps behind its columns that add nothing to
/// what comes by the open sky. Told by samples of points, all alike over the area.
bool apertures_matter(const Scene& scene, const PatchMesh& mesh, const VertexGather& points,
                      double noise, std::uint64_t seed);

/// Share of the area where apertures may bring more than `enough` [W/m²].
double lit_by_apertures(const PatchMesh& mesh, const VertexGather& points, double enough);

}  // namespace patchlight
