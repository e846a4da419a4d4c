#include "tests/bench/gathered_truth.h"

#include "solver/form_factors/point_factor.h"
#include "solver/rays/low_discrepancy.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace patchlight {

namespace {

constexpr int lamp_samples = 128;        // along each side
constexpr double more = 4.0;             // times as many rays, where there are too few
constexpr double differs_enough = 0.25;  // of the mean square: its halves want more rays [1]

using Random = std::mt19937_64;

float jitter(Random& random) { return static_cast<float>(random() >> 40) * 0x1p-24f; }

RayPoint start_of(const Scene& scene, const RayScene& rays, const TruePoint& point) {
    return rays.to_ray_space(point.position) +
           rays.lift(point.surface) * scene.surfaces[point.surface].normal.cast<float>();
}

double norm_of(const std::vector<TruePoint>& points) {
    double sum = 0.0;
    for (const TruePoint& point : points) sum += point.reflected(0) * point.reflected(1);
    return std::sqrt(sum);
}

/// Share of a lamp that is seen, by jittered samples over it.
double visible_share(const RayScene& rays, const RayPoint& origin, const RayPoint& normal,
                     const LightSource& lamp, Random& random) {
    RayBatch batch;
    std::array<float, ray_batch> weight;
    int filled = 0;
    double clear = 0.0, all = 0.0;
    const auto flush = [&] {
        const std::uint32_t blocked = rays.blocked(batch, filled);
        for (int k = 0; k < filled; ++k) {
            all += weight[k];
            if (!((blocked >> k) & 1u)) clear += weight[k];
        }
        filled = 0;
    };
    for (int n = 0; n < lamp_samples * lamp_samples; ++n) {
        const float u = (static_cast<float>(n % lamp_samples) + jitter(random)) / lamp_samples,
                    v = (static_cast<float>(n / lamp_samples) + jitter(random)) / lamp_samples;
        const RayPoint ray = lamp.sampler.at(u, v) + lamp.lift * lamp.sampler.normal - origin;
        const float squared = ray.squaredNorm();
        const float kernel = std::max(0.0f, ray.dot(normal)) *
                             std::max(0.0f, -ray.dot(lamp.sampler.normal)) / (squared * squared);
        if (!(kernel > 0.0f)) continue;
        batch.ox[filled] = origin.x(), batch.oy[filled] = origin.y(), batch.oz[filled] = origin.z();
        batch.dx[filled] = ray.x(), batch.dy[filled] = ray.y(), batch.dz[filled] = ray.z();
        weight[filled++] = kernel;
        if (filled == ray_batch) flush();
    }
    if (filled > 0) flush();
    return all > 0.0 ? clear / all : 0.0;
}

}  // namespace

double GatheredTruth::direct(const TruePoint& point, std::uint64_t seed) const {
    Random random(seed);
    const Surface& surface = scene_.surfaces[point.surface];
    const RayPoint origin = start_of(scene_, rays_, point), normal = surface.normal.cast<float>();
    double sum = 0.0;
    for (const LightSource& lamp : lamps_) {
        const double factor =
            point_factor(point.position, surface.normal, lamp.polygon, lamp.normal);
        if (factor > 0.0)
            sum += factor * luminance(lamp.exitance) *
                   visible_share(rays_, origin, normal, lamp, random);
    }
    return sum;
}

double GatheredTruth::indirect(const TruePoint& point, double rays, std::uint64_t seed) const {
    Random random(seed);
    const Vec3& normal = scene_.surfaces[point.surface].normal;
    const RayPoint origin = start_of(scene_, rays_, point);
    const PlaneFrame frame = frame_of(Vec3::Zero(), normal);
    const int side = static_cast<int>(std::sqrt(rays));
    RayBatch batch;
    LandingBatch landings;
    int filled = 0;
    double sum = 0.0;
    const auto flush = [&] {
        rays_.land(batch, filled, landings);
        for (int k = 0; k < filled; ++k)
            if (landings.landing[k] == Landing::front)
                sum +=
                    finer_.at(landings.surface[k], {landings.x[k], landings.y[k], landings.z[k]});
        filled = 0;
    };
    for (int n = 0; n < side * side; ++n) {
        const double u = (n % side + static_cast<double>(jitter(random))) / side,
                     turn = 2.0 * std::numbers::pi *
                            (n / side + static_cast<double>(jitter(random))) / side;
        const Vec3 d = std::sqrt(u) * (std::cos(turn) * frame.u + std::sin(turn) * frame.v) +
                       std::sqrt(std::max(1e-12, 1.0 - u)) * normal;
        batch.ox[filled] = origin.x(), batch.oy[filled] = origin.y(), batch.oz[filled] = origin.z();
        batch.dx[filled] = static_cast<float>(d.x());
        batch.dy[filled] = static_cast<float>(d.y());
        batch.dz[filled] = static_cast<float>(d.z());
        if (++filled == ray_batch) flush();
    }
    if (filled > 0) flush();
    return sum / (static_cast<double>(side) * side);
}

std::vector<TruePoint> GatheredTruth::spread(std::size_t count, std::uint64_t seed) const {
    std::vector<double> area;
    for (const Surface& surface : scene_.surfaces)
        area.push_back((area.empty() ? 0.0 : area.back()) + surface.area);
    Random random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<TruePoint> points(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double at = (static_cast<double>(k) + unit(random)) / static_cast<double>(count);
        const auto found = std::upper_bound(area.begin(), area.end() - 1, at * area.back());
        points[k].surface = static_cast<SurfaceIndex>(found - area.begin());
        const auto& corners = scene_.surfaces[points[k].surface].corners;
        points[k].reflectance =
            luminance(scene_.materials[scene_.surfaces[points[k].surface].material].reflectance);
        points[k].position = corners[0] + unit(random) * (corners[1] - corners[0]) +
                             unit(random) * (corners[3] - corners[0]);
    }
    return points;
}

/// Joins so many rays to those of each half.
void GatheredTruth::join(TruePoint& point, double rays, std::uint64_t seed) const {
    const double share = rays / (point.rays + rays);
    for (std::size_t half = 0; half < 2; ++half)
        point.indirect[half] +=
            share * (indirect(point, rays, mix(seed, half)) - point.indirect[half]);
    point.rays += rays;
}

std::vector<TruePoint> GatheredTruth::at_points(std::size_t count, std::uint64_t seed, double first,
                                                double most, double noise) const {
    std::vector<TruePoint> points = spread(count, seed);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        TruePoint& point = points[k];
        for (std::size_t half = 0; half < 2; ++half)
            point.direct[half] = direct(point, mix(seed, 4 * k + half));
        join(point, first, mix(seed, 4 * k + 2));
    });
    for (std::uint64_t round = 1; truth_noise(points) > noise; ++round) {
        const double enough = differs_enough * noise * norm_of(points);
        std::vector<std::size_t> unsure;
        for (std::size_t k = 0; k < count; ++k)
            if (std::abs(points[k].noise()) * std::sqrt(static_cast<double>(count)) > enough &&
                points[k].rays < most)
                unsure.push_back(k);
        if (unsure.empty()) break;
        tbb::parallel_for(std::size_t{0}, unsure.size(), [&](std::size_t k) {
            TruePoint& point = points[unsure[k]];
            join(point, more * point.rays, mix(seed + round, unsure[k]));
        });
    }
    return points;
}

double true_error(const std::vector<TruePoint>& points, const std::vector<double>& judged) {
    double sum = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        sum += (judged[k] - points[k].reflected(0)) * (judged[k] - points[k].reflected(1));
    return std::sqrt(std::max(0.0, sum)) / norm_of(points);
}

double truth_noise(const std::vector<TruePoint>& points) {
    double sum = 0.0;
    for (const TruePoint& point : points) sum += point.noise() * point.noise();
    return std::sqrt(sum) / norm_of(points);
}

}  // namespace patchlight
