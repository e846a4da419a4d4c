#include "solver/display/point_gather.h"

#include "solver/form_factors/point_factor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>

namespace patchlight {

namespace {
constexpr float tiny = 1e-12f;  // squared distance that is taken for no less [ray space]
/// Only samples next to the outline of what is seen are left to chance, √n of n along each length
/// of the lamp: about two such lengths in sight of a few boxes, or of a sky between walls.
constexpr double outlines = 2.0;
constexpr double wide = 0.15;  // of a point's view: a source may be sampled by directions [1]
constexpr double wide_for_height = 4.0;  // above its plane: most of its area hardly counts [1]

bool is_wide_from(const LightSource& source, const Vec3& from) {
    const double height = std::abs((from - source.polygon.corners[0]).dot(source.normal));
    return vector_area(source.polygon.view()).norm() >
           wide_for_height * wide_for_height * height * height;
}

/// Of a source that would give `whole` [W/m²].
int first_samples(const DirectEffort& effort, double whole) {
    if (!(whole > effort.bright)) return effort.first;
    return static_cast<int>(
        std::min<double>(effort.first * std::ceil(whole / effort.bright), effort.most));
}

/// Where a ray from `from` meets the front of a source.
std::optional<Vec3> meet(const LightSource& source, const Vec3& from, const Vec3& way) {
    const auto& corners = source.polygon.corners;
    const double along = way.dot(source.normal);
    if (!(along < 0.0)) return std::nullopt;
    const double t = (corners[0] - from).dot(source.normal) / along;
    if (!(t > 0.0)) return std::nullopt;
    const Vec3 p = from + t * way;
    for (std::size_t k = 0; k < source.polygon.size; ++k) {
        const Vec3& a = corners[k];
        const Vec3& b = corners[(k + 1) % source.polygon.size];
        if ((b - a).cross(p - a).dot(source.normal) < 0.0) return std::nullopt;
    }
    return p;
}
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

/// Segments that are traced together, and what share of their weight is clear.
struct PointGather::Samples {
    const PointGather& gather;
    const GatherPoint& point;
    const LightSource& source;
    Share& share;
    RayBatch batch = {};
    Lanes weights = {};
    int filled = 0;

    void add(const RayPoint& goal, const RayPoint& ray, float weight) {
        RayScene::set_segment(batch, filled, point.origin, point.frame, ray, goal,
                              source.sampler.frame);
        weights[static_cast<std::size_t>(filled++)] = weight;
        if (filled == ray_batch) trace();
    }
    void trace() {
        if (filled == 0) return;
        const std::uint32_t blocked = gather.rays_.blocked(batch, filled);
        for (std::size_t k = 0; k < static_cast<std::size_t>(filled); ++k) {
            share.all += weights[k];
            if ((blocked >> k) & 1u) continue;
            const RayPoint ray(batch.dx[k], batch.dy[k], batch.dz[k]);
            if (count_crossed(gather.apertures_, point.origin, ray) == 0) share.clear += weights[k];
        }
        filled = 0;
    }
};

void PointGather::sample(const GatherPoint& point, const LightSource& source, double factor,
                         std::uint64_t key, int first, int end, Share& share) const {
    const std::array<std::uint32_t, 2> seeds{static_cast<std::uint32_t>(key),
                                             static_cast<std::uint32_t>(key >> 32)};
    const RayPoint normal = point.normal.cast<float>(),
                   shift = rays_.shift(source.sampler.frame, point.frame).cast<float>();
    Samples samples{*this, point, source, share};
    const auto coordinate = [&](std::size_t d, int n) {
        return points_.at(d, static_cast<std::size_t>(n), seeds[d]);
    };
    if (factor > wide && is_wide_from(source, point.position)) {
        const RayFrame frame = frame_about(normal);
        const auto scaled = [&](int n) {
            return std::min(static_cast<int>(n / factor), static_cast<int>(points_.size()));
        };
        for (int n = scaled(first); n < scaled(end); ++n) {
            const RayPoint way = cosine_direction(frame, coordinate(0, n), coordinate(1, n));
            const std::optional<Vec3> met = meet(source, point.position, way.cast<double>());
            if (!met) continue;
            const RayPoint goal = rays_.to_ray_space(*met, source.sampler.frame) +
                                  source.lift * source.sampler.normal;
            samples.add(goal, goal + shift - point.origin, 1.0f);
        }
    } else {
        for (int n = first; n < end; ++n) {
            const RayPoint goal = source.sampler.at(coordinate(0, n), coordinate(1, n)) +
                                  source.lift * source.sampler.normal;
            const RayPoint ray = goal + shift - point.origin;
            const float squared = std::max(tiny, ray.squaredNorm());
            const float weight = std::max(0.0f, ray.dot(normal)) / squared *
                                 (std::max(0.0f, -ray.dot(source.sampler.normal)) / squared);
            if (weight > 0.0f) samples.add(goal, ray, weight);
        }
    }
    samples.trace();
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
            const double whole = factor * luminance(source.exitance);
            const int first = first_samples(effort, whole);
            Share share;
            sample(point, source, factor, stream, 0, first, share);
            if (share.mixed()) sample(point, source, factor, stream, first, effort.most, share);
            if (share.all > 0.0f) clear = static_cast<double>(share.clear / share.all);
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
