#pragma once

#include "solver/form_factors/form_factor_engine.h"
#include "solver/form_factors/hemicube_engine.h"
#include "solver/rays/ray_scene.h"
#include "solver/settings.h"

#include <functional>
#include <memory>

namespace patchlight {

/// The engine that planned settings name. The references must outlive it. `go_on` is asked now and
/// then, as this may take seconds; after a false nothing more should be asked of the engine.
std::unique_ptr<FormFactorEngine> make_engine(const Scene& scene, const PatchMesh& mesh,
                                              const RayScene& rays, const SolveSettings& planned,
                                              const std::function<bool()>& go_on);

HemicubeSettings hemicube_settings(const SolveSettings& planned);

}  // namespace patchlight
