#include "solver/findings/small_emitters.h"

#include "solver/findings/light_test.h"
#include "solver/findings/walkers.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/finding_words.h"
#include "solver/scene/polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace patchlight {

namespace {

constexpr double enough = 10.0;           // samples of a pair: noise of a third [1]
constexpr std::size_t landing_rays = 64;  // that tell where a lamp's light lands
constexpr std::size_t most_lamps = 1000;  // that are looked at
constexpr std::size_t emitters_named = 10;

/// Samples of a patch's hemisphere: rays, or as many cells of even share as a hemicube has.
double samples_of(const SolveSettings& planned) {
    if (planned.accuracy || planned.engine == Engine::analytic) return 0.0;
    if (planned.engine == Engine::ray_cast) return planned.rays.value_or(0);
    const double resolution = planned.hemicube_resolution.value_or(0);
    return std::numbers::pi / 4.0 * resolution * resolution;
}

/// As many lamps of equal power would vary as little in sum.
double effective_count(const std::vector<double>& power) {
    double sum = 0.0, squares = 0.0;
    for (const double p : power) sum += p, squares += p * p;
    return squares > 0.0 ? sum * sum / squares : 0.0;
}

/// Samples out of so many of each patch, from both ends, that connect the lamp with a patch it
/// lights: the median over its light.
double connecting(const FlawSearch& search, SurfaceIndex lamp, double samples, double patch_area) {
    const SurfacePoints points(search.scene.surfaces[lamp]);
    std::vector<Walker> walkers;
    for (std::size_t k = 0; k < landing_rays; ++k) {
        const std::uint64_t seed = mix(mix(search.seed, lamp), k);
        walkers.push_back(leave(search, lamp, points.at(seed), Side::front, seed));
    }
    fly(search.rays, walkers);
    const Surface& emitter = search.scene.surfaces[lamp];
    const double parts = std::max(1.0, emitter.area / patch_area);
    std::vector<double> counts;
    for (const Walker& walker : walkers) {
        if (walker.landing != Landing::front) continue;
        const Surface& lit = search.scene.surfaces[walker.surface];
        const Vec3 way = walker.direction.cast<double>();
        const double distance = static_cast<double>(walker.length) / search.rays.scale();
        const double kernel = way.dot(emitter.normal) * -way.dot(lit.normal) /
                              (std::numbers::pi * distance * distance);
        const double reached = emitter.area + parts * std::min(lit.area, patch_area);
        counts.push_back(samples * std::min(1.0, kernel * reached));
    }
    if (counts.empty()) return samples;
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::nth_element(counts.begin(), middle, counts.end());
    return *middle;
}

}  // namespace

std::vector<Finding> find_small_emitters(const FlawSearch& search, const SolveSettings& planned) {
    const double samples = samples_of(planned);
    if (!(samples > 0.0) || !planned.patch_size) return {};
    const LightTest light(search);
    const double lamps = effective_count(light.power());
    std::vector<std::string> names;
    std::set<std::string> known;
    double fewest = enough;
    SurfaceIndex worst = 0;
    std::size_t looked_at = 0, count = 0;
    for (SurfaceIndex s = 0; s < search.scene.surfaces.size() && looked_at < most_lamps; ++s) {
        if (!light.gives_light(s)) continue;
        ++looked_at;
        const double patch_area = *planned.patch_size * *planned.patch_size;
        const double met = lamps * connecting(search, s, samples, patch_area);
        if (met >= enough) continue;
        ++count;
        if (met < fewest) fewest = met, worst = s;
        const std::string& name = search.object_of(s);
        if (known.insert(name).second && names.size() < emitters_named) names.push_back(name);
    }
    if (count == 0) return {};
    const Surface& lamp = search.scene.surfaces[worst];
    return {{"small-emitter", names,
             "about " + number_text(fewest) + " of " + number_text(samples) +
                 (planned.engine == Engine::ray_cast ? " rays" : " hemicube cells") +
                 " connect the lamp " + quoted(search.object_of(worst)) + " near " +
                 place_text(centroid(lamp.corners, lamp.normal), search.size(worst)) +
                 " with a patch that it lights: its light is noise there",
             "ask for an `accuracy` or analytic form factors, which sample lamps one by one; or " +
                 number_text(std::ceil(enough / std::max(fewest, 1e-3))) + " times as many samples",
             count}};
}

}  // namespace patchlight
