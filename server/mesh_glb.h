#pragma once

#include "server/job.h"
#include "solver/solution.h"

#include <string>

namespace patchlight::server {

/// The display mesh as a binary glTF 2.0 file: a node and a mesh for each object that is shown,
/// under its path, in metres, turned so that the first camera's `up` is +Y, glTF's. Each vertex has
/// - POSITION;
/// - COLOR_0, linear: min(1, B/π 2^exposure), on an unlit white material, so that a viewer shows
/// the
///   colours of a .png of the same exposure [stops];
/// - _RADIOSITY and _IRRADIANCE, three floats each, in the units named in `asset.extras`.
/// There are no normals: light is in the colours. Surfaces are one-sided; both halves of a
/// two-sided one are there. Throws std::length_error if it would not fit into 4 GiB.
std::string mesh_glb(const Job& job, const Solution& solution, double exposure);

}  // namespace patchlight::server
