#include "solver/display/point_gather.h"

#include "solver/form_factors/point_factor.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {
constexpr float tiny = 1e-12f;  // squared distance that is taken for no less [ray space]
/// Only samples next to the outline of what is seen are left to chance, √n of n along each length
/// of the lamp: about two such lengths in sight of a few boxes, or of a sky between walls.
constexpr double outlines = 2.0;
}  // namespace

PointGather::PointGather(const RayScene& rays, std::vector<LightSource> sources, int most_samples,
                         std::vector<Aperture> apertures)
    : rays_(rays),
      sources_(std::move(sources)),
      apertures_(std::move(apertures)),
      points_(static_cast<std::size_t>(std::max(most_samples, ray_batch))) {
    if (apertures_.empty()) return;
    for (std::uint32_t s = 0; s < sources_.size(); ++s) {
        source_of_.resize(std::max<std::size_t>(source_of_.size(), sources_[s].surface + 1), 0);
        source_of_[sources_[s].surface] = s + 1;
    }
}

GatherPoint PointGather::at(const Vec3& position, const Vec3& normal, float lift,
                            FrameIndex frame) const {
    GatherPoint point;
    point.position = position;
    point.normal = normal;
    point.frame = frame;
    point.origin = rays_.to_ray_space(position, frame) + lift * normal.cast<float>();
    return point;
}

void PointGather::sample(const GatherPoint& point, const LightSource& source, std::uint64_t key,
                         int first, int end, Share& share) const {
    const std::array<std::uint32_t, 2> seeds{static_cast<std::uint32_t>(key),
                                             static_cast<std::uint32_t>(key >> 32)};
    const RayPoint normal = point.normal.cast<float>(),
                   shift = rays_.shift(source.sampler.frame, point.frame).cast<float>();
    RayBatch batch;
    Lanes weights;
    int filled = 0;
    const auto trace = [&] {
        const std::uint32_t blocked = rays_.blocked(batch, filled);
        for (int k = 0; k < filled; ++k) {
            share.all += weights[k];
            if ((blocked >> k) & 1u) continue;
            const auto lane = static_cast<std::size_t>(k);
            const RayPoint ray(batch.dx[lane], batch.dy[lane], batch.dz[lane]);
            if (count_crossed(apertures_, point.origin, ray) == 0) share.clear += weights[k];
        }
        filled = 0;
    };
    for (int n = first; n < end; ++n) {
        const auto at = static_cast<std::size_t>(n);
        const RayPoint goal =
            source.sampler.at(points_.at(0, at, seeds[0]), points_.at(1, at, seeds[1])) +
            source.lift * source.sampler.normal;
        const RayPoint ray = goal + shift - point.origin;
        const float squared = std::max(tiny, ray.squaredNorm());
        const float weight = std::max(0.0f, ray.dot(normal)) / squared *
                             (std::max(0.0f, -ray.dot(source.sampler.normal)) / squared);
        if (!(weight > 0.0f)) continue;
        RayScene::set_segment(batch, filled, point.origin, point.frame, ray, goal,
                              source.sampler.frame);
        weights[filled++] = weight;
        if (filled == ray_batch) trace();
    }
    if (filled > 0) trace();
}

PointGather::Direct PointGather::direct(const GatherPoint& point, const DirectEffort& effort,
                                        std::uint64_t key) const {
    Direct sum;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        const LightSource& source = sources_[s];
        const double factor =
            point_factor(point.position, point.normal, source.polygon, source.normal);
        if (!(factor > 0.0)) continue;
        double clear = 1.0;
        if (!point.clear || !(*point.clear)[s]) {
            const std::uint64_t stream = mix(key, s);
            Share share;
            sample(point, source, stream, 0, effort.first, share);
            if (share.mixed()) sample(point, source, stream, effort.first, effort.most, share);
            if (share.all > 0.0f) clear = static_cast<double>(share.clear / share.all);
            const double whole = factor * luminance(source.exitance);
            sum.variance +=
                outlines * whole * whole * clear * (1.0 - clear) * std::pow(effort.most, -1.5);
        }
        sum.irradiance += clear * factor * source.exitance;
    }
    for (std::size_t g = 0; g < apertures_.size(); ++g) {
        const Through found = through(point, apertures_[g], effort, mix(key, sources_.size() + g));
        sum.irradiance += found.irradiance;
        sum.variance += found.variance;
    }
    return sum;
}

}  // namespace patchlight
