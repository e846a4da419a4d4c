#include "solver/form_factors/hemisphere_rays.h"

#include "solver/rays/wide.h"

#include <algorithm>
#include <cmath>

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

using Lanes = std::array<float, ray_batch>;

/// Sobol coordinates of 16 successive points under one scramble for each dimension.
PATCHLIGHT_WIDE void scrambled(const std::array<const std::uint32_t*, 4>& reversed,
                               const std::array<std::uint32_t, 4>& seeds, std::array<Lanes, 4>& u) {
    for (std::size_t d = 0; d < 4; ++d) {
        const std::uint32_t seed = seeds[d];
        const std::uint32_t* const points = reversed[d];
        for (std::size_t k = 0; k < ray_batch; ++k) {
            const std::uint32_t x = reverse_bits(scramble_reversed(points[k], seed));
            u[d][k] = static_cast<float>(static_cast<std::int32_t>(x >> 8)) * 0x1p-24f;
        }
    }
}

/// sin(2πx) for |x| <= 1/4, to 6e-8: Taylor's series to x^11.
inline float sine_of_turn(float x) {
    const float t = x * x;
    return x * (6.2831853f +
                t * (-41.341702f +
                     t * (81.605249f + t * (-76.705860f + t * (42.058694f + t * -15.094642f)))));
}

/// Directions about the normal with density cosine / π: radius √u on the disk, angle 2πv, lifted.
PATCHLIGHT_WIDE void cosine_directions(const PatchSampler& s, const Lanes& u, const Lanes& v,
                                       RayBatch& batch) {
    for (std::size_t k = 0; k < ray_batch; ++k) {
        const float turn = v[k] - 0.5f;
        const float a = std::abs(turn);
        const float folded = a > 0.25f ? 0.5f - a : a;
        const float sine = sine_of_turn(turn < 0.0f ? -folded : folded);
        const float cosine = sine_of_turn(0.25f - a);
        const float radius = std::sqrt(u[k]);
        const float x = radius * cosine, y = radius * sine,
                    z = std::sqrt(std::max(1e-12f, 1.0f - u[k]));
        batch.dx[k] = x * s.tangent.x() + y * s.bitangent.x() + z * s.normal.x();
        batch.dy[k] = x * s.tangent.y() + y * s.bitangent.y() + z * s.normal.y();
        batch.dz[k] = x * s.tangent.z() + y * s.bitangent.z() + z * s.normal.z();
    }
}

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
    scrambled(reversed, seeds, u);
    const PatchSampler& s = samplers_[i];
    cosine_directions(s, u[2], u[3], batch);
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
