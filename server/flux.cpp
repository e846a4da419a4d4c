#include "server/flux.h"

#include "server/json_vectors.h"
#include "server/wording.h"

#include <unordered_map>

namespace patchlight::server {
namespace {

constexpr double most_flux = 1e15;      // [W or lm]
constexpr double most_exitance = 1e16;  // [W/m² or lm/m²]

bool emits(const Scene& scene, const Surface& surface) {
    return (scene.materials[surface.material].exitance > 0.0).any();
}

double emitting_area(const Scene& scene, SurfaceIndex first) {
    double area = 0.0;
    for (SurfaceIndex s = first; s < scene.surfaces.size(); ++s)
        if (emits(scene, scene.surfaces[s])) area += scene.surfaces[s].area;
    return area;
}

}  // namespace

void spread_flux(const JsonValue& flux, const std::string& path, SurfaceIndex first, Scene& scene,
                 MaterialNames& names) {
    const Rgb power = read_channels(flux, {0, most_flux});
    const double area = emitting_area(scene, first);
    if (!(area > 0.0))
        flux.reject(
            "no material of the object emits; give one an 'exitance' or a 'radiance', whose "
            "colour the flux then has");
    if (!((power / area) <= most_exitance).all())
        flux.reject("is too much for an area of " + number_text(area) + " m²");
    std::unordered_map<MaterialIndex, MaterialIndex> copies;
    for (SurfaceIndex s = first; s < scene.surfaces.size(); ++s) {
        Surface& surface = scene.surfaces[s];
        if (!emits(scene, surface)) continue;
        const auto [copy, is_new] = copies.try_emplace(surface.material);
        if (is_new) {
            Material material = scene.materials[surface.material];
            material.name += "@" + path;
            const Rgb colour = material.exitance / luminance(material.exitance);
            material.exitance = power / area;
            if (flux.is_number()) material.exitance *= colour;
            copy->second = names.add(std::move(material));
        }
        surface.material = copy->second;
    }
}

}  // namespace patchlight::server
