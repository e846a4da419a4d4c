#include "solver/accuracy/transport_check.h"

#include "solver/rays/low_discrepancy.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t pilot = 1024;  // particles that tell how many rays each takes
constexpr std::size_t fewest = 4096, most = 1 << 24;
constexpr double compared = 0.5;  // of the time there is: the rest is for comparing what landed
/// Noise of σ in each region makes Σ max(0, |miss| - 2σ)² about (0.107 σ)² of nothing: with
/// 0.3 of the target for that, regions of (0.107 / (0.3 target))² landings and more.
constexpr double by_chance = 0.107, allowed = 0.3;
constexpr double fewest_landings = 64.0;  // so that their noise is told by themselves
constexpr double most_regions = 2000.0;   // as much as shows where something is wrong
constexpr double most_for_doubt = 4e6;    // particles
constexpr double doubt_of_none = 3.0;     // over n: what n of n may have missed, to 95 %

double landings_for(double target) {
    return std::max(fewest_landings, std::pow(by_chance / (allowed * target), 2));
}

/// Most that one particle of a lamp stands for, times the number of all [W].
double most_of_one(const ParticleFlux& flux) {
    double most = 0.0;
    for (const LampFate& lamp : flux.lamps)
        most = std::max(most, lamp.power * static_cast<double>(flux.particles) /
                                  static_cast<double>(std::max<std::uint64_t>(1, lamp.particles)));
    return most;
}

double mean_reflectance(const Scene& scene) {
    double sum = 0.0, area = 0.0;
    for (const Surface& surface : scene.surfaces) {
        sum += surface.area * luminance(scene.materials[surface.material].reflectance);
        area += surface.area;
    }
    return area > 0.0 ? sum / area : 0.0;
}

}  // namespace

ParticleEvidence check_transport(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                                 const ApertureSet& apertures, const TreeDisplay& shown,
                                 const ShownPlaces& places, const ParticleEffort& effort,
                                 std::uint64_t seed) {
    ParticleEvidence evidence;
    const LightParticles particles(scene, mesh, rays, apertures);
    if (particles.empty() || !(effort.norm > 0.0)) return evidence;
    const auto start = std::chrono::steady_clock::now();
    const ParticleFlux first = particles.send(pilot, mix(seed, 0));
    const double each = static_cast<double>(first.rays) / static_cast<double>(first.particles),
                 landings = std::max(1.0, static_cast<double>(first.landings.size())) /
                            static_cast<double>(first.particles),
                 wanted = landings_for(effort.target);
    const double per_doubt =
        doubt_of_none * mean_reflectance(scene) / (std::sqrt(effort.area) * effort.norm);
    const double sure_enough = per_doubt * most_of_one(first) / (allowed * effort.target);
    double count = std::max(
        std::min(static_cast<double>(effort.rays) / each, most_regions * wanted / landings),
        std::min(sure_enough, most_for_doubt));
    if (std::isfinite(effort.seconds)) {
        const double of_pilot =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        count = std::min(count, compared * effort.seconds / of_pilot * static_cast<double>(pilot));
    }
    const ParticleFlux flux =
        particles.send(static_cast<std::size_t>(std::clamp(count, static_cast<double>(fewest),
                                                           static_cast<double>(most))),
                       mix(seed, 1));
    constexpr double deciding = 0.25;  // of the landings
    evidence.regions = make_flux_regions(scene, mesh, shown, places, flux,
                                         static_cast<int>(std::ceil(deciding * wanted)));
    evidence.check = compare_flux(evidence.regions, effort.norm);
    evidence.check.doubt = per_doubt * most_of_one(flux) / static_cast<double>(flux.particles);
    evidence.check.particles = flux.particles;
    evidence.check.rays = first.rays + flux.rays;
    return evidence;
}

}  // namespace patchlight
