#pragma once

#include "solver/solution.h"

#include <vector>

namespace patchlight {

/// Irradiance at each vertex of the display mesh, such that the radiosity there is exitance +
/// reflectance * irradiance, as it is on patches. It is never below 0. Where next to nothing is
/// reflected (reflectance below 1e-4), so that radiosity does not tell, it is the mean irradiance
/// of the adjoining patches, weighted by area [W/m²].
std::vector<Rgb> vertex_irradiance(const Scene& scene, const Solution& solution);

}  // namespace patchlight
