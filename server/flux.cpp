#include "server/flux.h"

#include "server/json_vectors.h"
#include "server/wording.h"

#include <unordered_map>

namespace patchlight::server {
namespace {

constexpr double most_flux = 1e15;      // [W or lm]
constexpr double most_exitance = 1e16;  // [W/m² or lm/m²]

}  // namespace

bool FluxSpreader::emits(const Surface& surface) const {
    return (scene_.materials[surface.material].exitance > 0.0).any();
}

double FluxSpreader::emitting_area(SurfaceIndex first) const {
    double area = 0.0;
    for (SurfaceIndex s = first; s < scene_.surfaces.size(); ++s)
        if (emits(scene_.surfaces[s])) area += scene_.surfaces[s].area;
    return area;
}

/// Itself, if it is the copy of a flux further down: no other object has it.
MaterialIndex FluxSpreader::copy_of(MaterialIndex given, const std::string& path) {
    if (copies_.contains(given)) return given;
    Material material = scene_.materials[given];
    material.name += "@" + path;
    const MaterialIndex copy = names_.add(std::move(material));
    copies_.insert(copy);
    return copy;
}

void FluxSpreader::spread(const JsonValue& flux, const std::string& path, SurfaceIndex first) {
    const Rgb power = read_channels(flux, {0, most_flux});
    const double area = emitting_area(first);
    if (!(area > 0.0))
        flux.reject(
            "no material of the object emits; give one an 'exitance' or a 'radiance', whose "
            "colour the flux then has");
    const Rgb exitance = power / area;
    if (!(exitance <= most_exitance).all())
        flux.reject("is too much for an area of " + number_text(area) + " m²");
    std::unordered_map<MaterialIndex, MaterialIndex> copies;
    for (SurfaceIndex s = first; s < scene_.surfaces.size(); ++s) {
        Surface& surface = scene_.surfaces[s];
        if (!copies.contains(surface.material) && !emits(surface)) continue;
        const auto [copy, is_new] = copies.try_emplace(surface.material);
        if (is_new) {
            copy->second = copy_of(surface.material, path);
            Rgb& emitted = scene_.materials[copy->second].exitance;
            const Rgb colour = emitted / luminance(emitted);
            emitted = flux.is_number() ? Rgb(exitance * colour) : exitance;
        }
        surface.material = copy->second;
    }
}

}  // namespace patchlight::server
