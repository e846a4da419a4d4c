#include "solver/display/point_gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr int fewest = ray_batch;        // samples of an aperture
constexpr float samples_of_size = 8.0f;  // times its width over the distance
constexpr int most_at_first = 64, most_ever = 8192, times_more = 4;
constexpr int most_of_many = 1024;    // what each of many misses evens out
constexpr std::size_t few = 4;        // apertures
constexpr int most_one_by_one = 128;  // first samples; else they are shared out among all
constexpr float reached = 1e-4f;      // of the way, by rounding
/// A point for each of n strata, of the variance of n points by chance.
constexpr double stratified = 0.5;

}  // namespace

/// ∫ E/π cosθ dω over apertures, where a ray goes on to a source: dω = |cosθ'| dA / r². A ray that
/// crosses n apertures counts 1/n here. Sources that nothing can hide from the point were counted
/// whole.
struct PointGather::ApertureSamples {
    const PointGather& gather;
    const GatherPoint& point;
    RayPoint normal = point.normal.cast<float>();
    RayBatch batch = {};
    std::array<float, ray_batch> weight = {};
    int filled = 0, taken = 0;
    Rgb sum = Rgb::Zero();
    double squares = 0.0;  // of luminances

    void add(std::size_t aperture, float u, float v, float times) {
        const Aperture& of = gather.apertures_[aperture];
        const Aperture::Pick pick = of.pick_from(point.origin, u, v);
        const RayPoint ray = pick.point - point.origin;
        const float squared = std::max(1e-14f, ray.squaredNorm());
        const auto k = static_cast<std::size_t>(filled);
        weight[k] = times * std::max(0.0f, ray.dot(normal)) * std::abs(ray.dot(of.normal)) *
                    pick.area / (squared * squared * std::numbers::pi_v<float>);
        ++taken;
        if (!(weight[k] > 0.0f)) return;
        batch.ox[k] = point.origin.x(), batch.dx[k] = ray.x();
        batch.oy[k] = point.origin.y(), batch.dy[k] = ray.y();
        batch.oz[k] = point.origin.z(), batch.dz[k] = ray.z();
        if (++filled == ray_batch) trace();
    }

    void trace() {
        LandingBatch landed;
        const auto count = static_cast<std::size_t>(std::exchange(filled, 0));
        if (count > 0) gather.rays_.land(batch, static_cast<int>(count), landed);
        for (std::size_t k = 0; k < count; ++k) {
            if (landed.landing[k] != Landing::front ||
                landed.surface[k] >= gather.source_of_.size() ||
                gather.source_of_[landed.surface[k]] == 0)
                continue;
            const std::size_t s = gather.source_of_[landed.surface[k]] - 1;
            if (point.clear && (*point.clear)[s]) continue;
            const RayPoint whole = RayPoint(landed.x[k], landed.y[k], landed.z[k]) - point.origin;
            const RayPoint ray(batch.dx[k], batch.dy[k], batch.dz[k]);
            if (whole.squaredNorm() < (1.0f - reached) * ray.squaredNorm()) continue;
            const int crossed = std::max(1, gather.apertures_.count_crossed(point.origin, whole));
            const Rgb arriving =
                static_cast<double>(weight[k]) / crossed * gather.sources_[s].exitance;
            sum += arriving;
            squares += std::pow(luminance(arriving), 2);
        }
    }

    /// Mean of the samples so far, and the variance of it.
    Direct mean() {
        trace();
        const double y = luminance(sum) / taken;
        return {sum / taken,
                stratified * std::max(0.0, squares / taken - y * y) / std::max(1.0, taken - 1.0)};
    }
};

PointGather::Direct PointGather::through(const GatherPoint& point, double whole,
                                         const DirectEffort& effort, std::uint64_t key) const {
    const RayPoint normal = point.normal.cast<float>();
    std::vector<float> most(apertures_.size());
    apertures_.most_through(point.origin, normal, most);
    struct Open {
        std::size_t aperture = 0;
        int count = 0;            // of its first samples
        double cumulative = 0.0;  // of the most that comes through
    };
    std::vector<Open> open;
    const double negligible = effort.enough / static_cast<double>(most.size());
    double sum = 0.0;
    int wanted = 0;
    for (std::size_t g = 0; g < most.size(); ++g) {
        if (!(static_cast<double>(most[g]) > negligible)) continue;
        const Aperture& aperture = apertures_[g];
        const float size = std::min(aperture.first_edge.norm(), aperture.second_edge.norm()),
                    far = (aperture.at(0.5f, 0.5f) - point.origin).norm();
        const int count = std::clamp(
            static_cast<int>(samples_of_size * size / std::max(far, 1e-6f)), fewest, most_at_first);
        wanted += count;
        open.push_back({g, count, sum += static_cast<double>(most[g])});
    }
    Direct found;
    const double enough = effort.enough / std::sqrt(effort.lit_by_apertures);
    // Of n samples that agree, one more may see all that can come through.
    const auto is_enough = [&](const Direct& part, int count, double all, double parts,
                               double light) {
        const double doubt = std::min(all, whole) / count;
        return std::max(part.variance, doubt * doubt) * parts <=
               std::pow(std::max(enough, effort.alike * light), 2);
    };
    // Of samples half of which are clear 1/n is the noise, squared.
    const double asked = std::min(1.0 / (effort.alike * effort.alike), double{most_ever});
    const int more = std::clamp(effort.most, most_at_first,
                                open.size() > few ? most_of_many : static_cast<int>(asked));
    const auto coordinate = [&](std::size_t d, std::size_t k, std::uint64_t of) {
        return points_.at(d, k, static_cast<std::uint32_t>(mix(of, d)));
    };
    if (wanted <= most_one_by_one) {
        const auto take = [&](const Open& one, int count) {
            ApertureSamples samples{*this, point};
            const std::uint64_t of = mix(key, one.aperture);
            for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k)
                samples.add(one.aperture, coordinate(0, k, of), coordinate(1, k, of), 1.0f);
            return samples.mean();
        };
        std::vector<Direct> parts;
        for (const Open& one : open) {
            parts.push_back(take(one, one.count));
            found.irradiance += parts.back().irradiance;
        }
        const double light = luminance(found.irradiance), all = static_cast<double>(open.size());
        found = {};
        for (std::size_t k = 0; k < open.size(); ++k) {
            const auto through_it = static_cast<double>(most[open[k].aperture]);
            int count = open[k].count;
            while (count < more && !is_enough(parts[k], count, through_it, all, light)) {
                count = std::min(count * times_more, more);
                parts[k] = take(open[k], count);
            }
            found.irradiance += parts[k].irradiance;
            found.variance += parts[k].variance;
        }
        return found;
    }
    // Each sample picks an aperture in proportion to what may come through, at steps all alike.
    const auto take = [&](int count) {
        ApertureSamples samples{*this, point};
        const double start = unit(mix(key, 0)), step = sum / count;
        std::size_t at = 0;
        for (int n = 0; n < count; ++n) {
            while (at + 1 < open.size() && open[at].cumulative <= (n + start) * step) ++at;
            const auto k = static_cast<std::size_t>(n);
            const float chance =
                static_cast<float>(static_cast<double>(most[open[at].aperture]) / sum);
            samples.add(open[at].aperture, coordinate(0, k, key), coordinate(1, k, key),
                        1.0f / chance);
        }
        return samples.mean();
    };
    int count = most_one_by_one;
    for (found = take(count);
         count < more && !is_enough(found, count, sum, 1.0, luminance(found.irradiance));
         found = take(count))
        count = std::min(count * times_more, more);
    return found;
}

PointGather::ThroughApertures PointGather::through_apertures(const GatherPoint& point,
                                                             const DirectEffort& effort,
                                                             std::uint64_t key) const {
    double whole = 0.0;
    for (std::size_t s = 0; s < sources_.size(); ++s) {
        if (point.clear && (*point.clear)[s]) continue;
        whole += luminance(sources_[s].exitance) * factor(point, s, effort.alike);
    }
    if (!(whole > 0.0)) return {};
    return {through(point, whole, effort, mix(key, sources_.size())).irradiance, whole};
}

}  // namespace patchlight
