#include "server/selftest/known_way.h"

#include "server/solve_json.h"
#include "server/wording.h"

#include <cmath>
#include <stdexcept>

namespace patchlight::server {

std::vector<KnownWay> every_way() {
    std::vector<KnownWay> ways;
    for (const Engine engine : {Engine::analytic, Engine::ray_cast, Engine::hemicube})
        for (const Method method : {Method::gauss_seidel, Method::shooting})
            ways.push_back({engine, method});
    return ways;
}

SolveSettings settings_of(const KnownWay& way, double patch_size, int rays) {
    SolveSettings settings;
    settings.engine = way.engine;
    settings.method = way.method;
    settings.patch_size = patch_size;
    settings.tolerance = 1e-8;
    if (way.engine == Engine::hemicube)
        settings.hemicube_resolution = static_cast<int>(std::lround(std::sqrt(rays)));
    else
        settings.rays = rays;
    return settings;
}

SolveSettings to_accuracy(double accuracy) {
    SolveSettings settings;
    settings.accuracy = accuracy;
    return settings;
}

std::string method_text(const SolveSettings& settings) {
    if (settings.accuracy) return "accuracy " + number_text(*settings.accuracy);
    return name_of(settings.engine) + " " + name_of(settings.method);
}

double factor_bound(const Solution& solution, double factor, double patches) {
    switch (solution.settings.engine) {
        case Engine::analytic:
            return quadrature * factor;
        case Engine::ray_cast:
            return deviations *
                   std::sqrt(factor * (1.0 - factor) / (patches * *solution.settings.rays));
        case Engine::hemicube: {
            const HemicubeErrors& errors = *solution.form_factors.hemicube;
            return 2.0 * errors.proximity +
                   deviations * (errors.aliasing + errors.visibility) / std::sqrt(patches);
        }
        case Engine::automatic:
            break;
    }
    throw std::logic_error("a solution without an engine");
}

}  // namespace patchlight::server
