#include "solver/display/lit_area.h"

#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace patchlight {

namespace {

constexpr std::size_t rays_of_all = 4096, rays_of_one = 64;
constexpr double reach = 3.0;  // of the median distance of a surface's lit points

}  // namespace

double lit_area(const Scene& scene, const RayScene& rays, const std::vector<LightSource>& sources,
                std::uint64_t seed) {
    const auto sends_back = [&](const Surface& surface) {
        return (scene.materials[surface.material].reflectance > 0.0).any();
    };
    std::map<SurfaceIndex, std::vector<double>> distances;  // of landings [m]
    RayBatch batch;
    LandingBatch landed;
    const std::size_t count = std::min(rays_of_all, rays_of_one * sources.size());
    for (std::size_t first = 0; first < count; first += ray_batch) {
        for (std::size_t k = 0; k < ray_batch; ++k) {
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
        rays.land(batch, ray_batch, landed);
        for (std::size_t k = 0; k < ray_batch; ++k)
            if (landed.landing[k] == Landing::front &&
                sends_back(scene.surfaces[landed.surface[k]]))
                distances[landed.surface[k]].push_back(
                    static_cast<double>((RayPoint(landed.x[k], landed.y[k], landed.z[k]) -
                                         RayPoint(batch.ox[k], batch.oy[k], batch.oz[k]))
                                            .norm()) /
                    rays.scale());
    }
    double area = 0.0;
    for (auto& [s, of] : distances) {
        const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
        std::nth_element(of.begin(), middle, of.end());
        area += std::min(scene.surfaces[s].area, std::numbers::pi * std::pow(reach * *middle, 2));
    }
    if (area > 0.0) return area;
    for (const Surface& surface : scene.surfaces) area += sends_back(surface) ? surface.area : 0.0;
    return area;
}

}  // namespace patchlight
