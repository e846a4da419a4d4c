#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/form_factors/hemicube_engine.h"
#include "solver/rays/ray_scene.h"
#include "solver/settings.h"

#include <memory>

namespace patchlight {

/// The engine that planned settings name. The references must outlive it.
std::unique_ptr<FormFactorEngine> make_engine(const Scene& scene, const PatchMesh& mesh,
                                              const RayScene& rays, const SolveSettings& planned);

HemicubeSettings hemicube_settings(const SolveSettings& planned);

}  // namespace patchlight
