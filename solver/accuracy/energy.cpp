#include "solver/accuracy/energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight {

EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh, const Rgb& backs,
                            const Rgb& escaped, const std::vector<Rgb>& irradiance) {
    EnergyReport energy;
    energy.backs = backs;
    energy.escaped = escaped;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        const Material& material = scene.materials[scene.surfaces[patch.surface].material];
        energy.emitted += patch.area * material.exitance;
        energy.absorbed += patch.area * (1.0 - material.reflectance) * irradiance[i];
    }
    const Rgb lost = energy.missing().abs();
    for (int c = 0; c < 3; ++c)
        if (energy.emitted[c] > 0.0)
            energy.defect = std::max(energy.defect, lost[c] / energy.emitted[c]);
    return energy;
}

EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh,
                            const std::vector<double>& backs, const std::vector<double>& escaped,
                            const std::vector<Rgb>& radiosity, const std::vector<Rgb>& irradiance) {
    Rgb to_backs = Rgb::Zero(), outside = Rgb::Zero();
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        to_backs += mesh.patches[i].area * backs[i] * radiosity[i];
        outside += mesh.patches[i].area * escaped[i] * radiosity[i];
    }
    return measure_energy(scene, mesh, to_backs, outside, irradiance);
}

EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh,
                            const ExchangeMatrix& exchange, const std::vector<Rgb>& radiosity,
                            const std::vector<Rgb>& irradiance) {
    return measure_energy(scene, mesh, exchange.backs, exchange.escaped, radiosity, irradiance);
}

EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh, const OutsideFlux& outside,
                            const std::vector<Rgb>& irradiance) {
    EnergyReport energy = measure_energy(scene, mesh, outside.backs, outside.escaped, irradiance);
    for (int c = 0; c < 3; ++c)
        if (energy.emitted[c] > 0.0)
            energy.standard_error =
                std::max(energy.standard_error, outside.standard_error[c] / energy.emitted[c]);
    return energy;
}

double error_proven_by_energy(const Scene& scene, const PatchMesh& mesh, const EnergyReport& energy,
                              const std::vector<Rgb>& irradiance, const std::vector<double>& backs,
                              const std::vector<double>& escaped) {
    constexpr double sure = 2.0;  // standard errors
    Rgb taken = Rgb::Zero(), norm = Rgb::Zero(), darkest = Rgb::Ones();
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const Patch& patch = mesh.patches[i];
        if (patch.covered) continue;
        const Rgb& reflectance =
            scene.materials[scene.surfaces[patch.surface].material].reflectance;
        darkest = darkest.min(reflectance);
        const Rgb share = (1.0 - reflectance) / reflectance.max(1e-300) + backs[i] + escaped[i];
        taken += patch.area * share * share;
        norm += patch.area * (reflectance * irradiance[i]).square();
    }
    double proven = 0.0;
    for (int c = 0; c < 3; ++c) {
        if (!(darkest[c] > 0.0) || !(norm[c] > 0.0) || !(energy.emitted[c] > 0.0)) continue;
        const double lost =
            std::abs(energy.missing()[c]) - sure * energy.standard_error * energy.emitted[c];
        proven = std::max(proven, lost / std::sqrt(taken[c] * norm[c]));
    }
    return proven;
}

std::vector<ObjectReport> measure_objects(const Scene& scene, const Solution& solution) {
    std::vector<ObjectReport> objects(scene.objects.size());
    for (ObjectReport& object : objects) {
        object.min = Rgb::Constant(std::numeric_limits<double>::infinity());
        object.max = -object.min;
    }
    const auto object_of = [&](PatchIndex i) -> ObjectReport& {
        return objects[scene.surfaces[solution.mesh.patches[i].surface].object];
    };
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        const Patch& patch = solution.mesh.patches[i];
        if (patch.covered) continue;
        ObjectReport& object = object_of(i);
        object.area += patch.area;
        object.radiosity += patch.area * solution.radiosity[i];
        object.irradiance += patch.area * solution.irradiance[i];
        object.emitted +=
            patch.area * scene.materials[scene.surfaces[patch.surface].material].exitance;
    }
    for (std::size_t t = 0; t < solution.display.triangles.size(); ++t)
        for (const std::uint32_t vertex : solution.display.triangles[t]) {
            ObjectReport& object = object_of(solution.display.patch[t]);
            object.min = object.min.min(solution.display.radiosity[vertex]);
            object.max = object.max.max(solution.display.radiosity[vertex]);
        }
    for (ObjectReport& object : objects) {
        if (object.area > 0.0) {
            object.radiosity /= object.area;
            object.irradiance /= object.area;
        }
        if (!object.min.isFinite().all())
            object.min = object.max = object.radiosity;  // wholly covered: 0, as its area
    }
    return objects;
}

}  // namespace patchlight
