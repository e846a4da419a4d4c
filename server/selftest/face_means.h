#pragma once

#include "server/selftest/known_scene.h"
#include "solver/solution.h"

#include <array>

namespace patchlight::server {

using SixMeans = std::array<double, 6>;  // of faces x0, x1, y0, … [W/m²]

/// Mean radiosity of the faces of a unit cube, over the patches of all objects whose names begin
/// with that of the face; covered patches are left out.
SixMeans patch_means(const Scene& scene, const Solution& solution);

/// The same of the field that pictures show.
SixMeans display_means(const Scene& scene, const Solution& solution);

}  // namespace patchlight::server
