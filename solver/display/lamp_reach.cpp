#include "solver/display/lamp_reach.h"

#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace patchlight {

namespace {

constexpr std::size_t rays_of_all = 4096, rays_of_one = 64;
constexpr double wide = 3.0;  // of the median distance of a surface's lit points

}  // namespace

LampReach find_lamp_reach(const Scene& scene, const RayScene& rays,
                          const std::vector<LightSource>& sources, std::uint64_t seed) {
    LampReach reached;
    reached.landed.assign(sources.size(), 0.0);
    const auto sends_back = [&](const Surface& surface) {
        return (scene.materials[surface.material].reflectance > 0.0).any();
    };
    std::map<SurfaceIndex, std::vector<double>> distances;  // of landings [m]
    RayBatch batch;
    LandingBatch landed;
    const std::size_t of_one =
        sources.empty() ? 0 : std::clamp(rays_of_all / sources.size(), std::size_t{1}, rays_of_one);
    const std::size_t count = of_one * sources.size();
    for (std::size_t first = 0; first < count; first += ray_batch) {
        const std::size_t filled = std::min<std::size_t>(ray_batch, count - first);
        for (std::size_t k = 0; k < filled; ++k) {
            const std::uint64_t key = mix(seed, first + k);
            const auto random = [&](std::uint64_t d) {
                return static_cast<float>(unit(mix(key, d)));
            };
            const LightSource& source = sources[(first + k) % sources.size()];
            const RayPoint from = source.sampler.at(random(0), random(1)) +
                                  source.lift * source.sampler.normal,
                           way = cosine_direction(frame_about(source.sampler.normal), random(2),
                                                  random(3));
            batch.ox[k] = from.x(), batch.oy[k] = from.y(), batch.oz[k] = from.z();
            batch.dx[k] = way.x(), batch.dy[k] = way.y(), batch.dz[k] = way.z();
            batch.frame[k] = source.sampler.frame;
        }
        rays.land(batch, static_cast<int>(filled), landed);
        for (std::size_t k = 0; k < filled; ++k) {
            if (landed.landing[k] != Landing::front ||
                !sends_back(scene.surfaces[landed.surface[k]]))
                continue;
            const RayPoint way = RayPoint(landed.x[k], landed.y[k], landed.z[k]) -
                                 RayPoint(batch.ox[k], batch.oy[k], batch.oz[k]);
            distances[landed.surface[k]].push_back(static_cast<double>(way.norm()) / rays.scale());
            reached.landed[(first + k) % sources.size()] += 1.0 / static_cast<double>(of_one);
        }
    }
    double& area = reached.area;
    for (auto& [s, of] : distances) {
        const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
        std::nth_element(of.begin(), middle, of.end());
        area += std::min(scene.surfaces[s].area, std::numbers::pi * std::pow(wide * *middle, 2));
    }
    if (area > 0.0) return reached;
    for (const Surface& surface : scene.surfaces) area += sends_back(surface) ? surface.area : 0.0;
    return reached;
}

}  // namespace patchlight
