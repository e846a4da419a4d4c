#include "solver/display/point_gather.h"

#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr float tiny = 1e-12f;       // squared distance that is taken for no less [ray space]
constexpr float most_weight = 4.0f;  // of a ray that grazes one surface and not the other
constexpr int samples_per_ray = 4;   // rays to one sample of the excess
/// Both halves of one scrambled sequence differ more than independent ones would: as the variance
/// falls with the power 1.44 of the number of rays, by this.
constexpr double halves_are_opposed = 0.59;

using Sum = std::array<double, 3>;

void add(Sum& sum, const std::array<float, 3>& radiosity, float weight) {
    for (std::size_t c = 0; c < 3; ++c)
        sum[c] += static_cast<double>(weight) * static_cast<double>(radiosity[c]);
}

Rgb mean(const Sum& sum, int count) { return Rgb(sum[0], sum[1], sum[2]) / count; }

}  // namespace

double PointGather::Indirect::variance(const Rgb& reflectance) const {
    const double y = luminance(reflectance * half_difference);
    return halves_are_opposed * y * y;
}

/// One of several surfaces at a point, and the light on it.
struct PointGather::Tilted {
    RayPoint normal;  // unit
    Sum rays{}, excess{};
    double total = 0.0;  // what rays would bring of light that is 1 everywhere

    /// How much more a ray counts here than about the normal it was made for.
    float weight(const RayPoint& direction, float cosine) const {
        return std::clamp(direction.dot(normal) / std::max(cosine, 1e-6f), 0.0f, most_weight);
    }
};

/// Rays [first, end) over the hemisphere. A ray that meets the excess counts it as much as the
/// balance with `ratio` samples of it per ray leaves.
struct PointGather::Hemisphere {
    const PointGather& gather;
    const GatherPoint& point;
    const ReflectedField& field;
    std::array<std::uint32_t, 2> seeds;
    RayFrame frame;
    float ratio;

    /// visit(direction, radiosity, weight) of each ray; of those that meet no front of 0.
    template <typename Visit>
    void trace(int first, int end, const Visit& visit) const {
        RayBatch batch;
        batch.ox.fill(point.origin.x());
        batch.oy.fill(point.origin.y());
        batch.oz.fill(point.origin.z());
        batch.frame.fill(point.frame);
        LandingBatch landings;
        std::array<Lanes, 2> u;
        for (int n = first; n < end; n += ray_batch) {
            scramble_lanes({gather.points_.reversed(0) + n, gather.points_.reversed(1) + n}, seeds,
                           u);
            cosine_directions(frame, u[0], u[1], batch);
            gather.rays_.land(batch, ray_batch, landings);
            for (int k = 0; k < ray_batch; ++k) meet(batch, landings, k, visit);
        }
    }

    template <typename Visit>
    void meet(const RayBatch& batch, const LandingBatch& landings, int k,
              const Visit& visit) const {
        const RayPoint direction(batch.dx[k], batch.dy[k], batch.dz[k]);
        if (landings.landing[k] != Landing::front) {
            visit(direction, std::array<float, 3>{}, 0.0f);
            return;
        }
        const RayPoint at(landings.x[k], landings.y[k], landings.z[k]);
        const ReflectedField::Seen seen = field.at(landings.surface[k], at.x(), at.y(), at.z());
        float weight = 1.0f;
        if (ratio > 0.0f && seen.density > 0.0f) {
            const RayPoint shift =
                gather.rays_.shift(gather.rays_.frame(landings.surface[k]), point.frame)
                    .cast<float>();
            const float squared = std::max(tiny, (at + shift - point.origin).squaredNorm());
            const float density =  // of rays, per area
                std::max(0.0f, direction.dot(frame.normal)) *
                std::max(0.0f, -direction.dot(field.normal(landings.surface[k]))) /
                (std::numbers::pi_v<float> * squared);
            weight -= seen.excess_share * ratio * seen.density / (density + ratio * seen.density);
        }
        visit(direction, seen.radiosity, weight);
    }

    Sum sum(int first, int end) const {
        Sum total{};
        trace(first, end, [&](const RayPoint&, const auto& radiosity, float weight) {
            if (weight > 0.0f) add(total, radiosity, weight);
        });
        return total;
    }

    void sum(int first, int end, std::span<Tilted> tilted) const {
        trace(first, end, [&](const RayPoint& direction, const auto& radiosity, float weight) {
            const float cosine = direction.dot(frame.normal);
            for (Tilted& one : tilted) {
                const float times = one.weight(direction, cosine);
                one.total += static_cast<double>(times);
                if (weight > 0.0f) add(one.rays, radiosity, times * weight);
            }
        });
    }
};

/// Samples [first, end) of the excess, each weighed so that the sum over both, divided by the
/// number of rays, is what arrives.
struct PointGather::Excess {
    const PointGather& gather;
    const GatherPoint& point;
    const ReflectedField& field;
    std::array<std::uint32_t, 3> seeds;
    RayPoint normal;
    float ratio;

    /// visit(ray, radiosity, weight) of each that is seen.
    template <typename Visit>
    void trace(int first, int end, const Visit& visit) const {
        RayBatch batch;
        std::array<ReflectedField::Seen, ray_batch> seen;
        std::array<float, ray_batch> weights;
        int filled = 0;
        const auto trace_some = [&] {
            const std::uint32_t blocked = gather.rays_.blocked(batch, filled);
            for (int k = 0; k < filled; ++k)
                if (!((blocked >> k) & 1u))
                    visit(RayPoint(batch.dx[k], batch.dy[k], batch.dz[k]), seen[k].radiosity,
                          weights[k]);
            filled = 0;
        };
        for (int n = first; n < end; ++n) {
            const auto at = static_cast<std::size_t>(n);
            const ReflectedField::Sample sample =
                field.sample(gather.points_.at(0, at, seeds[0]), gather.points_.at(1, at, seeds[1]),
                             gather.points_.at(2, at, seeds[2]));
            const RayPoint shift = gather.rays_.shift(sample.frame, point.frame).cast<float>();
            const RayPoint ray = sample.position + shift - point.origin;
            const float squared = std::max(tiny, ray.squaredNorm());
            const float density =
                std::max(0.0f, ray.dot(normal)) / squared *
                (std::max(0.0f, -ray.dot(sample.normal)) / (std::numbers::pi_v<float> * squared));
            if (!(density > 0.0f) || !sample.on_patch) continue;
            RayScene::set_segment(batch, filled, point.origin, point.frame, ray, sample.position,
                                  sample.frame);
            seen[filled] = sample.seen;
            weights[filled++] =
                sample.seen.excess_share * density / (density + ratio * sample.seen.density);
            if (filled == ray_batch) trace_some();
        }
        if (filled > 0) trace_some();
    }

    Sum sum(int first, int end) const {
        Sum total{};
        trace(first, end, [&](const RayPoint&, const auto& radiosity, float weight) {
            add(total, radiosity, weight);
        });
        return total;
    }

    void sum(int first, int end, std::span<Tilted> tilted) const {
        trace(first, end, [&](const RayPoint& ray, const auto& radiosity, float weight) {
            const float cosine = ray.dot(normal);
            for (Tilted& one : tilted) add(one.excess, radiosity, one.weight(ray, cosine) * weight);
        });
    }
};

PointGather::Indirect PointGather::indirect(const GatherPoint& point, const ReflectedField& field,
                                            int first, int end, std::uint64_t key) const {
    const float ratio = field.has_excess() ? 1.0f / samples_per_ray : 0.0f;
    const auto word = [&](std::uint64_t k) { return static_cast<std::uint32_t>(mix(key, k)); };
    const RayFrame frame = frame_about(point.normal.cast<float>());
    const Hemisphere hemisphere{*this, point, field, {word(0), word(1)}, frame, ratio};
    const Excess excess{*this, point, field, {word(2), word(3), word(4)}, frame.normal, ratio};
    const int half = (end - first) / 2;
    std::array<Rgb, 2> parts;
    for (int h = 0; h < 2; ++h) {
        const int from = first + h * half, to = from + half;
        Sum sum = hemisphere.sum(from, to);
        if (ratio > 0.0f) {
            const Sum more = excess.sum(from / samples_per_ray, to / samples_per_ray);
            for (std::size_t c = 0; c < 3; ++c) sum[c] += more[c];
        }
        parts[static_cast<std::size_t>(h)] = mean(sum, half);
    }
    return {0.5 * (parts[0] + parts[1]), 0.5 * (parts[0] - parts[1])};
}

void PointGather::indirect(const GatherPoint& point, std::span<const Vec3> normals,
                           const ReflectedField& field, int first, int end, std::uint64_t key,
                           std::span<Indirect> found) const {
    const float ratio = field.has_excess() ? 1.0f / samples_per_ray : 0.0f;
    const auto word = [&](std::uint64_t k) { return static_cast<std::uint32_t>(mix(key, k)); };
    const RayFrame frame = frame_about(point.normal.cast<float>());
    const Hemisphere hemisphere{*this, point, field, {word(0), word(1)}, frame, ratio};
    const Excess excess{*this, point, field, {word(2), word(3), word(4)}, frame.normal, ratio};
    const int half = (end - first) / 2;
    std::array<std::vector<Rgb>, 2> parts;
    for (std::size_t h = 0; h < 2; ++h) {
        const int from = first + static_cast<int>(h) * half, to = from + half;
        std::vector<Tilted> tilted;
        for (const Vec3& normal : normals) tilted.push_back({normal.cast<float>()});
        hemisphere.sum(from, to, tilted);
        if (ratio > 0.0f) excess.sum(from / samples_per_ray, to / samples_per_ray, tilted);
        for (const Tilted& one : tilted)
            parts[h].push_back(Rgb(one.rays[0], one.rays[1], one.rays[2]) /
                                   std::max(one.total, 1e-6) +
                               mean(one.excess, half));
    }
    for (std::size_t k = 0; k < normals.size(); ++k)
        found[k] = {0.5 * (parts[0][k] + parts[1][k]), 0.5 * (parts[0][k] - parts[1][k])};
}

}  // namespace patchlight
