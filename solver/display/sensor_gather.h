#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/rays/ray_scene.h"
#include "solver/solution.h"

#include <functional>
#include <vector>

namespace patchlight {

/// Irradiance gathered at each sensor: Lambert's formula for every patch, clipped at the sensor's
/// horizon, times its visibility, which rays weighted with the kernel measure: few where all agree,
/// many where they do not. Surfaces within 1e-6 of the scene's size behind a sensor do not block.
/// `go_on` is told the fraction done now and then, from the calling thread; after a false there
/// are reports of the first sensors alone.
std::vector<SensorReport> gather_at_sensors(const Scene& scene, const PatchMesh& mesh,
                                            const RayScene& ray_scene,
                                            const std::vector<Rgb>& radiosity, std::uint64_t seed,
                                            const std::function<bool(double)>& go_on = {});

}  // namespace patchlight
