#include "solver/form_factors/ray_cast_engine.h"

#include <algorithm>

namespace patchlight {

namespace {
constexpr int rays_between_looks = 4096 * ray_batch;  // at the clock
}

RayCastEngine::RayCastEngine(const Scene& scene, const PatchMesh& mesh, const RayScene& ray_scene,
                             int rays, std::uint64_t seed)
    : mesh_(mesh),
      ray_scene_(ray_scene),
      locator_(scene, mesh, ray_scene),
      hemisphere_(scene, mesh, ray_scene, rays, seed) {}

void RayCastEngine::cast(PatchIndex i, Tally& tally) const {
    RayBatch batch;
    LandingBatch landings;
    for (int first = 0; first < hemisphere_.count(); first += ray_batch) {
        if (first % rays_between_looks == 0) look_at_clock();
        const int count = hemisphere_.fill(i, first, batch);
        ray_scene_.land(batch, count, landings);
        for (int k = 0; k < count; ++k) {
            switch (landings.landing[k]) {
                case Landing::escaped:
                    ++tally.escaped;
                    break;
                case Landing::back:
                    ++tally.backs;
                    break;
                case Landing::front:
                    if (!tally.hits.empty())
                        ++tally.hits[locator_.find(landings.surface[k], landings.x[k],
                                                   landings.y[k], landings.z[k])];
                    break;
            }
        }
    }
}

void RayCastEngine::row(PatchIndex i, FactorRow& row) const {
    row.clear();
    if (mesh_.patches[i].covered) {
        row.outside = outside(i);
        return;
    }
    Tally tally;
    tally.hits.assign(mesh_.size(), 0);
    cast(i, tally);
    row.rays = static_cast<std::uint64_t>(hemisphere_.count());
    const double n = hemisphere_.count();
    row.outside = Outside{tally.backs / n, tally.escaped / n, row.rays};
    tally.hits[i] =
        0;  // a planar patch does not see itself; a ray that says so was misled by rounding
    for (PatchIndex j = 0; j < mesh_.size(); ++j) {
        if (tally.hits[j] == 0) continue;
        const double factor = tally.hits[j] / n;
        const double most = std::min(1.0, mesh_.patches[j].area / mesh_.patches[i].area);
        row.add(j, factor, factor * (1.0 - factor) / n, most);
    }
}

Outside RayCastEngine::outside(PatchIndex i) const {
    if (mesh_.patches[i].covered) return {1.0, 0.0, 0};
    Tally tally;
    cast(i, tally);
    const double n = hemisphere_.count();
    return {tally.backs / n, tally.escaped / n, static_cast<std::uint64_t>(hemisphere_.count())};
}

}  // namespace patchlight
