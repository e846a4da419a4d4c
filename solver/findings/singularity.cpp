#include "solver/findings/singularity.h"

#include "solver/findings/walkers.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"
#include "solver/scene/polygon.h"

#include <algorithm>
#include <map>

namespace patchlight {

namespace {

constexpr double nearly_all = 0.985;     // of the light that is left after a reflection [1]
constexpr std::size_t walks_each = 256;  // from each object
constexpr std::size_t most_objects = 64;
constexpr int long_flights = 16;

/// Objects with a surface that reflects nearly all light, and the largest such surface of each.
std::map<ObjectIndex, std::vector<SurfaceIndex>> bright_objects(const Scene& scene) {
    std::map<ObjectIndex, std::vector<SurfaceIndex>> bright;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        if (scene.materials[surface.material].reflectance.maxCoeff() < nearly_all) continue;
        if (bright.size() < most_objects || bright.contains(surface.object))
            bright[surface.object].push_back(s);
    }
    return bright;
}

/// The share of light that is left after a reflection, in the channel where it is largest.
double left_after_reflection(const FlawSearch& search, const std::vector<SurfaceIndex>& from) {
    std::vector<double> areas;
    for (const SurfaceIndex s : from) areas.push_back(search.scene.surfaces[s].area);
    std::vector<Walker> walkers;
    for (const std::uint32_t k : draw(areas, walks_each, mix(search.seed, from[0]))) {
        const std::uint64_t seed = mix(mix(search.seed, from[k]), walkers.size());
        walkers.push_back(leave(search, from[k],
                                SurfacePoints(search.scene.surfaces[from[k]]).at(seed), Side::front,
                                seed));
    }
    Rgb left = Rgb::Zero();
    double counted = 0.0;
    for (int flight = 0; flight < long_flights; ++flight) {
        fly(search.rays, walkers);
        for (const Walker& walker : walkers) {
            if (!walker.flying) continue;
            counted += 1.0;
            if (walker.landing == Landing::front)
                left += search.scene.materials[search.scene.surfaces[walker.surface].material]
                            .reflectance;
        }
        turn(search, walkers);
    }
    return counted > 0.0 ? left.maxCoeff() / counted : 0.0;
}

}  // namespace

std::vector<Finding> find_singularity(const FlawSearch& search) {
    Finding finding{"near-singular", {}, "", "", 1};
    double most = 0.0;
    SurfaceIndex where = 0;
    for (const auto& [object, surfaces] : bright_objects(search.scene)) {
        const double left = left_after_reflection(search, surfaces);
        if (left < nearly_all) continue;
        finding.objects.push_back(search.scene.objects[object].name);
        if (left <= most) continue;
        most = left;
        where = *std::max_element(
            surfaces.begin(), surfaces.end(), [&](SurfaceIndex a, SurfaceIndex b) {
                return search.scene.surfaces[a].area < search.scene.surfaces[b].area;
            });
    }
    if (finding.objects.empty()) return {};
    const Surface& surface = search.scene.surfaces[where];
    const std::string times = number_text(1.0 / std::max(1.0 - most, 1e-9));
    finding.detail = "light that is enclosed near " +
                     place_text(centroid(surface.corners, surface.normal), search.size(where)) +
                     " loses only " + share_text(1.0 - most) +
                     " at each reflection: errors of form factors and of rounding grow up to " +
                     times + " times";
    finding.remedy = "give the surfaces a reflectance that exists: white paint has about 0.85";
    return {finding};
}

}  // namespace patchlight
