#include "server/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight::server {

double automatic_exposure(const Scene& scene, const Solution& solution) {
    constexpr double middle_grey = 0.3;  // where L* comes to lie in the picture
    double weight = 0.0;                 // ∫ L dA
    double weighted = 0.0;               // ∫ L² dA
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        const Patch& patch = solution.mesh.patches[i];
        if (patch.covered) continue;
        const Material& material = scene.materials[scene.surfaces[patch.surface].material];
        const Rgb reflected = solution.radiosity[i] - material.exitance;
        const double seen = std::max(0.0, luminance(reflected)) / std::numbers::pi;
        weight += patch.area * seen;
        weighted += patch.area * seen * seen;
    }
    return weighted > 0.0 ? std::log2(middle_grey * weight / weighted) : 0.0;
}

}  // namespace patchlight::server
