#include "solver/accuracy/error_estimate.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr int fewest_points = 12;       // on an object that is judged by itself
constexpr double bright_enough = 0.02;  // of the scene's norm, an object that is judged by itself

}  // namespace

ReflectedLight measure_reflected(const Scene& scene, const PatchMesh& mesh,
                                 const std::vector<Rgb>& reflected, const std::vector<Rgb>& once) {
    ReflectedLight light;
    light.norm_of_object.assign(scene.objects.size(), 0.0);
    double all = 0.0, at_once = 0.0;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        const Surface& surface = scene.surfaces[patch.surface];
        const double y = luminance(reflected[i]);
        light.area += patch.area;
        light.norm_of_object[surface.object] += patch.area * y * y;
        all += patch.area * y;
        at_once += patch.area * luminance(scene.materials[surface.material].reflectance * once[i]);
    }
    for (double& norm : light.norm_of_object) {
        light.norm += norm;
        norm = std::sqrt(norm);
    }
    light.norm = std::sqrt(light.norm);
    if (at_once > 0.0) light.bounces = std::max(1.0, all / at_once);
    return light;
}

void estimate_error(const CheckReport& checks, const ReflectedLight& light, double coarse,
                    double standard_errors, ErrorReport& error) {
    if (!(light.norm > 0.0)) return;
    const double alike = std::abs(checks.mean()) / std::sqrt(light.area) / light.norm;
    error.mesh = passed_on * checks.at_most(standard_errors) / light.norm;
    error.form_factors = std::hypot(coarse, (light.bounces - 1.0) * alike);
    error.estimate =
        error.algebraic_bound.value_or(0.0) + std::hypot(*error.form_factors, *error.mesh);
    error.worst.reset();
    for (ObjectIndex o = 0; o < checks.of_object.size(); ++o) {
        const auto& object = checks.of_object[o];
        const double norm = light.norm_of_object[o];
        if (object.points < fewest_points || norm < bright_enough * light.norm) continue;
        const double estimate = std::sqrt(std::max(0.0, object.square)) / norm;
        if (!error.worst || estimate > error.worst->estimate) error.worst = {o, estimate};
    }
}

}  // namespace patchlight
