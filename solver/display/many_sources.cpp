#include "solver/display/point_gather.h"

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr float least_squared = 1e-12f;  // distance that is taken for no less [ray space]
constexpr int first_of_many = 4;         // times the first samples of one

}  // namespace

/// Samples of all sources together, each picked in proportion to what it would give, at steps all
/// alike along their sum: what of their light is clear, in two halves that know nothing of each
/// other.
struct PointGather::ManySamples {
    const PointGather& gather;
    const GatherPoint& point;
    std::span<const Lit> lit;
    bool by_apertures;
    std::vector<double> cumulative = {};
    RayPoint normal = {};
    RayBatch batch = {};
    std::array<Rgb, ray_batch> light = {};
    int filled = 0;
    Rgb clear = Rgb::Zero(), all = Rgb::Zero();  // of one half

    void trace() {
        if (filled == 0) return;
        const std::uint32_t blocked = gather.rays_.blocked(batch, filled);
        for (std::size_t k = 0; k < static_cast<std::size_t>(filled); ++k) {
            all += light[k];
            if ((blocked >> k) & 1u) continue;
            const RayPoint ray(batch.dx[k], batch.dy[k], batch.dz[k]);
            if (!by_apertures || gather.apertures_.count_crossed(point.origin, ray) == 0)
                clear += light[k];
        }
        filled = 0;
    }

    void add(const Lit& picked, float u, float v) {
        const LightSource& source = gather.sources_[picked.source];
        const RayPoint goal = source.sampler.at(u, v) + source.lift * source.sampler.normal,
                       ray = goal +
                             gather.rays_.shift(source.sampler.frame, point.frame).cast<float>() -
                             point.origin;
        const float squared = std::max(least_squared, ray.squaredNorm());
        const float kernel = std::max(0.0f, ray.dot(normal)) / squared *
                             (std::max(0.0f, -ray.dot(source.sampler.normal)) / squared);
        if (!(kernel > 0.0f)) return;
        // Times the area, over the factor: 1 on average over the source.
        const double weight = static_cast<double>(kernel) * source.area / picked.factor;
        light[static_cast<std::size_t>(filled)] =
            weight / picked.whole * picked.factor * source.exitance;
        RayScene::set_segment(batch, filled++, point.origin, point.frame, ray, goal,
                              source.sampler.frame);
        if (filled == ray_batch) trace();
    }

    /// Share of what is clear, per channel.
    Rgb half(int count, std::uint64_t key) {
        const std::array<std::uint32_t, 3> seeds{static_cast<std::uint32_t>(key),
                                                 static_cast<std::uint32_t>(key >> 32),
                                                 static_cast<std::uint32_t>(mix(key, 2))};
        clear = all = Rgb::Zero();
        const double start = unit(mix(key, 3)), step = cumulative.back() / count;
        std::size_t at = 0;
        for (int n = 0; n < count; ++n) {
            const double goal = (n + start) * step;
            while (at + 1 < cumulative.size() && cumulative[at] <= goal) ++at;
            const auto k = static_cast<std::size_t>(n);
            add(lit[at], gather.points_.at(0, k, seeds[0]), gather.points_.at(1, k, seeds[1]));
        }
        trace();
        Rgb share = Rgb::Ones();
        for (Eigen::Index c = 0; c < 3; ++c)
            if (all[c] > 0.0) share[c] = clear[c] / all[c];
        return share;
    }
};

PointGather::Direct PointGather::together(const GatherPoint& point, std::span<const Lit> lit,
                                          const DirectEffort& effort, std::uint64_t key) const {
    ManySamples samples{*this, point, lit, effort.by_apertures};
    samples.normal = point.normal.cast<float>();
    Rgb whole = Rgb::Zero();
    double sum = 0.0;
    for (const Lit& one : lit) {
        whole += one.factor * sources_[one.source].exitance;
        samples.cumulative.push_back(sum += one.whole);
    }
    Direct found;
    const auto take = [&](int count) {
        const std::array<Rgb, 2> halves{whole * samples.half(count / 2, mix(key, 0)),
                                        whole * samples.half(count / 2, mix(key, 1))};
        found.irradiance = 0.5 * (halves[0] + halves[1]);
        found.variance = std::pow(0.5 * luminance(halves[0] - halves[1]), 2);
    };
    const int first = std::min(first_of_many * effort.first_of(sum / first_of_many), effort.most);
    take(first);
    const double clear = luminance(found.irradiance) / std::max(luminance(whole), 1e-300);
    // Of samples by chance, as the halves may be alike by chance.
    const double expected = clear * (1.0 - clear) * sum * sum / first;
    if (first < effort.most && clear > 0.0 && clear < 1.0 &&
        expected > effort.enough * effort.enough)
        take(effort.most);
    return found;
}

}  // namespace patchlight
