#include "solver/display/light_spots.h"

#include "solver/rays/low_discrepancy.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t lines = 128;  // through each aperture

float unit_number(std::uint64_t bits) { return static_cast<float>(bits >> 40) * 0x1p-24f; }

}  // namespace

/// A gap of width w at a from a lamp of width l lights, at b beyond it, w (1 + b/a) + l b/a.
LightSpots::LightSpots(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                       const std::vector<LightSource>& sources,
                       const std::vector<Aperture>& apertures, std::uint64_t seed) {
    if (apertures.empty() || sources.empty()) return;
    spots_.resize(mesh.size());
    const PatchLocator locator(scene, mesh, rays);
    std::vector<double> power;  // cumulated
    std::vector<float> width;
    for (const LightSource& source : sources) {
        power.push_back((power.empty() ? 0.0 : power.back()) + source.power);
        width.push_back(static_cast<float>(narrow_side(source.polygon) * rays.scale()));
    }
    RayBatch batch;
    LandingBatch landed;
    for (std::size_t g = 0; g < apertures.size(); ++g)
        for (std::size_t n = 0; n < lines; ++n) {
            const std::uint64_t key = mix(mix(seed, g), n);
            const auto random = [&](std::uint64_t k) { return unit_number(mix(key, k)); };
            const double at = static_cast<double>(random(0)) * power.back();
            const std::size_t by_power = std::min<std::size_t>(
                static_cast<std::size_t>(std::upper_bound(power.begin(), power.end(), at) -
                                         power.begin()),
                power.size() - 1);
            const std::size_t s = n % 2 == 0 ? by_power : mix(key, 1) % sources.size();
            const LightSource& source = sources[s];
            const RayPoint from = source.sampler.at(random(2), random(3)) +
                                  source.lift * source.sampler.normal,
                           through = apertures[g].at(random(4), random(5)), ray = through - from;
            if (!(ray.dot(source.sampler.normal) > 0.0f)) continue;
            batch.ox[0] = from.x(), batch.oy[0] = from.y(), batch.oz[0] = from.z();
            batch.dx[0] = ray.x(), batch.dy[0] = ray.y(), batch.dz[0] = ray.z();
            rays.land(batch, 1, landed);
            if (landed.landing[0] != Landing::front) continue;
            const RayPoint place(landed.x[0], landed.y[0], landed.z[0]);
            const float before = ray.norm(), after = (place - from).norm() - before;
            if (!(after > 0.0f)) continue;
            const float gap = std::min(apertures[g].first_edge.norm(),
                                       apertures[g].second_edge.norm()),
                        wide = gap * (1.0f + after / before) + width[s] * after / before;
            const PatchIndex i = locator.find(landed.surface[0], place.x(), place.y(), place.z());
            spots_[i].push_back({rays.from_ray_space(place.cast<double>()),
                                 static_cast<double>(wide) / rays.scale()});
        }
}

bool LightSpots::may_hide_spot(const RefinementTree& tree, const TreeElement& element) const {
    if (spots_.empty() || spots_[element.patch].empty()) return false;
    Vec3 centre = Vec3::Zero();
    const std::size_t n = element.corner_count();
    for (std::size_t k = 0; k < n; ++k)
        centre += tree.vertices()[element.vertices[k]].position / static_cast<double>(n);
    double radius = 0.0;
    for (std::size_t k = 0; k < n; ++k)
        radius = std::max(radius, (tree.vertices()[element.vertices[k]].position - centre).norm());
    return std::any_of(spots_[element.patch].begin(), spots_[element.patch].end(),
                       [&](const Spot& spot) {
                           return radius > 0.5 * spot.width &&
                                  (spot.place - centre).norm() < radius + 0.5 * spot.width;
                       });
}

}  // namespace patchlight
