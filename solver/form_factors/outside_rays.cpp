#include "solver/form_factors/outside_rays.h"

#include <oneapi/tbb/parallel_for.h>

namespace patchlight {

Outside OutsideRays::at(PatchIndex i) const {
    if (mesh_.patches[i].covered) return {1.0, 0.0, 0};
    RayBatch batch;
    LandingBatch landings;
    int backs = 0, escaped = 0;
    for (int first = 0; first < rays_.count(); first += ray_batch) {
        const int count = rays_.fill(i, first, batch);
        ray_scene_.land(batch, count, landings);
        for (int k = 0; k < count; ++k) {
            backs += landings.landing[k] == Landing::back;
            escaped += landings.landing[k] == Landing::escaped;
        }
    }
    const double n = rays_.count();
    return {backs / n, escaped / n, static_cast<std::uint64_t>(rays_.count())};
}

std::vector<Outside> OutsideRays::everywhere() const {
    std::vector<Outside> outside(mesh_.size());
    tbb::parallel_for(std::size_t{0}, mesh_.size(),
                      [&](std::size_t i) { outside[i] = at(static_cast<PatchIndex>(i)); });
    return outside;
}

}  // namespace patchlight
