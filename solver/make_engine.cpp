#include "solver/make_engine.h"

#include "solver/form_factors/analytic_engine.h"
#include "solver/form_factors/ray_cast_engine.h"

#include <stdexcept>

namespace patchlight {

HemicubeSettings hemicube_settings(const SolveSettings& planned) {
    HemicubeSettings settings;
    settings.resolution = *planned.hemicube_resolution;
    settings.seed = planned.seed;
    return settings;
}

std::unique_ptr<FormFactorEngine> make_engine(const Scene& scene, const PatchMesh& mesh,
                                              const RayScene& rays, const SolveSettings& planned,
                                              const std::function<bool()>& go_on) {
    switch (planned.engine) {
        case Engine::analytic: {
            AnalyticSettings analytic;
            analytic.rays = *planned.rays;
            analytic.seed = planned.seed;
            return std::make_unique<AnalyticEngine>(scene, mesh, rays, analytic, go_on);
        }
        case Engine::ray_cast:
            return std::make_unique<RayCastEngine>(scene, mesh, rays, *planned.rays, planned.seed);
        case Engine::hemicube:
            return std::make_unique<HemicubeEngine>(scene, mesh, rays, hemicube_settings(planned));
        case Engine::automatic:
            break;
    }
    throw std::logic_error("engine without a case");
}

}  // namespace patchlight
