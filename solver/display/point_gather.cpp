#include "solver/display/point_gather.h"

#include "solver/form_factors/point_factor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace patchlight {

namespace {
constexpr float tiny = 1e-12f;  // squared distance that is taken for no less [ray space]
/// Only samples next to the outline of what is seen are left to chance, √n of n along each length
/// of the lamp: about two such lengths in sight of a few boxes, or of a sky between walls.
constexpr double outlines = 2.0;
constexpr double of_lamp = 0.1;           // of the noise that is of no matter, one lamp's [1]
constexpr double most_times_first = 8.0;  // as many first samples of a source, however bright
constexpr double wide = 0.15;  // of a point's view: a source may be sampled by directions [1]
constexpr std::size_t many_sources = 256;
constexpr double wide_for_height = 4.0;  // above its plane: most of its area hardly counts [1]

bool is_wide_from(const LightSource& source, const Vec3& from) {
    const double height = std::abs((from - source.polygon.corners[0]).dot(source.normal));
    return vector_area(source.polygon.view()).norm() >
           wide_for_height * wide_for_height * height * height;
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

std::vector<Aperture> that_hide_lamps(std::vector<Aperture> apertures) {
    std::erase_if(apertures, [](const Aperture& aperture) { return !aperture.hides_lamps; });
    return apertures;
}
}  // namespace

int DirectEffort::first_of(double whole) const {
    if (!(whole > bright)) return first;
    const double times = std::min(std::ceil(whole / bright), most_times_first);
    return std::min(static_cast<int>(first * times), std::max(first, most));
}

PointGather::PointGather(const RayScene& rays, std::vector<LightSource> sources, int most_samples,
                         const std::vector<Aperture>& apertures)
    : rays_(rays),
      sources_(std::move(sources)),
      gaps_(apertures, sources_, rays),
      apertures_(that_hide_lamps(apertures), sources_, rays),
      points_(static_cast<std::size_t>(std::max(most_samples, ray_batch))) {
    if (sources_.size() > many_sources)
        for (const LightSource& source : sources_) afar_.push_back(make_afar(source));
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

PointGather::Afar PointGather::make_afar(const LightSource& source) {
    const std::span<const Vec3> corners = source.polygon.view();
    Afar afar{centroid(corners, source.normal), source.normal, source.area / std::numbers::pi};
    for (const Vec3& p : corners)
        afar.squared_radius = std::max(afar.squared_radius, (p - afar.centre).squaredNorm());
    return afar;
}

double PointGather::factor(const GatherPoint& point, std::size_t s, double may_err) const {
    if (!afar_.empty()) {
        const Afar& afar = afar_[s];
        const Vec3 ray = afar.centre - point.position;
        const double squared = ray.squaredNorm();
        if (afar.squared_radius < may_err * squared) {
            const double here = ray.dot(point.normal), there = -ray.dot(afar.normal);
            return here > 0.0 && there > 0.0
                       ? afar.area_over_pi * here * there / (squared * squared)
                       : 0.0;
        }
    }
    return point_factor(point.position, point.normal, sources_[s].polygon, sources_[s].normal);
}

/// Segments that are traced together, and what share of their weight is clear.
struct PointGather::Samples {
    const PointGather& gather;
    const GatherPoint& point;
    const LightSource& source;
    Share& share;
    bool by_apertures;
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
            if (!by_apertures || gather.apertures_.count_crossed(point.origin, ray) == 0)
                share.clear += weights[k];
        }
        filled = 0;
    }
};

void PointGather::sample(const GatherPoint& point, const LightSource& source, double factor,
                         bool by_apertures, std::uint64_t key, int first, int end,
                         Share& share) const {
    const std::array<std::uint32_t, 2> seeds{static_cast<std::uint32_t>(key),
                                             static_cast<std::uint32_t>(key >> 32)};
    const RayPoint normal = point.normal.cast<float>(),
                   shift = rays_.shift(source.sampler.frame, point.frame).cast<float>();
    Samples samples{*this, point, source, share, by_apertures};
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

PointGather::Direct PointGather::alone(const GatherPoint& point, const Lit& lit,
                                       const DirectEffort& effort, std::uint64_t key) const {
    const LightSource& source = sources_[lit.source];
    int count = effort.first_of(lit.whole);
    Share share;
    sample(point, source, lit.factor, effort.by_apertures, key, 0, count, share);
    const auto variance = [&] {
        const double clear = share.clear_share();
        return outlines * lit.whole * lit.whole * clear * (1.0 - clear) * std::pow(count, -1.5);
    };
    if (share.mixed() && count < effort.most && variance() > std::pow(of_lamp * effort.enough, 2)) {
        sample(point, source, lit.factor, effort.by_apertures, key, count, effort.most, share);
        count = effort.most;
    }
    return {share.clear_share() * lit.factor * source.exitance, variance()};
}

PointGather::Direct PointGather::direct(const GatherPoint& point, const DirectEffort& effort,
                                        std::uint64_t key) const {
    constexpr std::size_t most_alone = 16;
    Direct sum;
    std::vector<Lit> hidden;  // or not
    double whole = 0.0;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        const LightSource& source = sources_[s];
        const double seen = factor(point, s, effort.alike);
        if (!(seen > 0.0)) continue;
        if (point.clear && (*point.clear)[s]) {
            sum.irradiance += seen * source.exitance;
            continue;
        }
        hidden.push_back({s, seen, seen * luminance(source.exitance)});
        whole += hidden.back().whole;
    }
    const auto add = [&](const Direct& more) {
        sum.irradiance += more.irradiance;
        sum.variance += more.variance;
    };
    auto many = hidden.end();
    if (hidden.size() > most_alone)
        many = std::stable_partition(hidden.begin(), hidden.end(), [&](const Lit& lit) {
            return lit.whole * most_alone >= whole;
        });
    for (auto lit = hidden.begin(); lit != many; ++lit)
        add(alone(point, *lit, effort, mix(key, lit->source)));
    if (many != hidden.end()) add(together(point, {many, hidden.end()}, effort, mix(key, ~0u)));
    if (effort.by_apertures && !apertures_.empty() && whole > 0.0)
        add(through(point, whole, effort, mix(key, sources_.size())));
    return sum;
}

}  // namespace patchlight
