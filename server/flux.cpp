#include "server/flux.h"

#include "server/json_vectors.h"
#include "server/wording.h"

#include "solver/scene/seen_area.h"

#include <unordered_map>

namespace patchlight::server {
namespace {

constexpr double most_flux = 1e15;      // [W or lm]
constexpr double most_exitance = 1e16;  // [W/m² or lm/m²]

}  // namespace

bool FluxSpreader::emits(const Surface& surface) const {
    return (scene_.materials[surface.material].exitance > 0.0).any();
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

void FluxSpreader::ask(const JsonValue& flux, const std::string& path, SurfaceIndex first) {
    const auto end = static_cast<SurfaceIndex>(scene_.surfaces.size());
    const Rgb power = read_channels(flux, {0, most_flux});
    bool any = false;
    for (SurfaceIndex s = first; s < end; ++s) any = any || emits(scene_.surfaces[s]);
    if (!any)
        flux.reject(
            "no material of the object emits; give one an 'exitance' or a 'radiance', whose "
            "colour the flux then has");
    wishes_.push_back({flux.pointer(), path, power, !flux.is_number(), first, end});
}

void FluxSpreader::spread_all(FaultList& faults) {
    if (wishes_.empty()) return;
    const std::vector<double> areas = seen_areas(scene_, find_coplanar_overlaps(scene_));
    for (const Wish& wish : wishes_) faults.attempt([&] { spread(wish, areas); });
}

void FluxSpreader::spread(const Wish& wish, const std::vector<double>& areas) {
    double area = 0.0, given = 0.0;
    for (SurfaceIndex s = wish.first; s < wish.end; ++s)
        if (emits(scene_.surfaces[s])) {
            area += areas[s];
            given += scene_.surfaces[s].area;
        }
    if (given > 0.0 && !(area > 0.0))
        throw InputError(
            wish.pointer,
            "all that emits of the object is covered by polygons in its plane that are listed "
            "later: list the object after them, or move it off their plane");
    if (!(area > 0.0)) return;  // what a flux of 0 further down has put out
    const Rgb exitance = wish.power / area;
    if (!(exitance <= most_exitance).all())
        throw InputError(wish.pointer, "is too much for an area of " + number_text(area) + " m²");
    std::unordered_map<MaterialIndex, MaterialIndex> copies;
    for (SurfaceIndex s = wish.first; s < wish.end; ++s) {
        Surface& surface = scene_.surfaces[s];
        if (!copies.contains(surface.material) && !emits(surface)) continue;
        const auto [copy, is_new] = copies.try_emplace(surface.material);
        if (is_new) {
            copy->second = copy_of(surface.material, wish.path);
            Rgb& emitted = scene_.materials[copy->second].exitance;
            const Rgb colour = emitted / luminance(emitted);
            emitted = wish.coloured ? exitance : Rgb(exitance * colour);
        }
        surface.material = copy->second;
    }
}

}  // namespace patchlight::server
