#include "solver/form_factors/hemisphere_rays.h"

#include "solver/rays/cosine_directions.h"
#include "solver/rays/wide.h"

#include <algorithm>

namespace patchlight {

HemisphereRays::HemisphereRays(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                               int count, std::uint64_t seed)
    : points_(static_cast<std::size_t>(count)), seed_(seed) {
    samplers_.reserve(mesh.size());
    lift_.reserve(mesh.size());
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const SurfaceIndex s = mesh.patches[i].surface;
        samplers_.push_back(make_sampler(mesh, i, scene.surfaces[s].normal, rays));
        lift_.push_back(rays.lift(s));
    }
}

namespace {

PATCHLIGHT_WIDE void parallelogram_origins(const PatchSampler& s, const RayPoint& corner,
                                           const Lanes& u, const Lanes& v, RayBatch& batch) {
    const float width = 1.0f - 2.0f * s.margin;
    for (std::size_t k = 0; k < ray_batch; ++k) {
        const float a = s.margin + width * u[k], b = s.margin + width * v[k];
        batch.ox[k] = corner.x() + a * s.first_edge.x() + b * s.second_edge.x();
        batch.oy[k] = corner.y() + a * s.first_edge.y() + b * s.second_edge.y();
        batch.oz[k] = corner.z() + a * s.first_edge.z() + b * s.second_edge.z();
    }
}

}  // namespace

int HemisphereRays::fill(PatchIndex i, int first, RayBatch& batch) const {
    const std::uint64_t low = mix(seed_, 2 * std::uint64_t{i}),
                        high = mix(seed_, 2 * std::uint64_t{i} + 1);
    const std::array<std::uint32_t, 4> seeds{
        static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> 32),
        static_cast<std::uint32_t>(high), static_cast<std::uint32_t>(high >> 32)};
    std::array<const std::uint32_t*, 4> reversed;
    for (std::size_t d = 0; d < 4; ++d) reversed[d] = points_.reversed(d) + first;
    std::array<Lanes, 4> u;
    scramble_lanes(reversed, seeds, u);
    const PatchSampler& s = samplers_[i];
    batch.frame.fill(s.frame);
    cosine_directions({s.tangent, s.bitangent, s.normal}, u[2], u[3], batch);
    const RayPoint above = lift_[i] * s.normal;
    if (s.parallelogram) {
        parallelogram_origins(s, s.corner + above, u[0], u[1], batch);
    } else {
        for (std::size_t k = 0; k < ray_batch; ++k) {
            const RayPoint origin = s.at(u[0][k], u[1][k]) + above;
            batch.ox[k] = origin.x();
            batch.oy[k] = origin.y();
            batch.oz[k] = origin.z();
        }
    }
    return std::min(ray_batch, count() - first);
}

}  // namespace patchlight
