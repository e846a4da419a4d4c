#include "solver/display/point_gather.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr int fewest = ray_batch;  // samples of an aperture
constexpr std::size_t many = 32;   // apertures
constexpr int fewest_of_many = 4;
constexpr float samples_of_size = 8.0f;  // times its size over the distance
constexpr int most_at_first = 64, most_ever = 1024;
constexpr double alike = 0.05;    // of their mean: samples that need no more beside them
constexpr float reached = 1e-4f;  // of the way, by rounding
/// A point for each of n strata, of the variance of n points by chance.
constexpr double stratified = 0.5;

bool is_below(const GatherPoint& point, const RayPoint& normal, const Aperture& aperture) {
    const auto height = [&](const RayPoint& p) { return (p - point.origin).dot(normal); };
    const RayPoint far = aperture.corner + aperture.first_edge + aperture.second_edge;
    return height(aperture.corner) <= 0.0f && height(far) <= 0.0f &&
           height(aperture.corner + aperture.first_edge) <= 0.0f &&
           height(aperture.corner + aperture.second_edge) <= 0.0f;
}

}  // namespace

/// ∫ E/π cosθ dω over the aperture, where a ray goes on to a source: dω = |cosθ'| dA / r². A ray
/// that crosses n apertures counts 1/n here. Sources that nothing can hide from the point were
/// counted whole.
PointGather::Through PointGather::through(const GatherPoint& point, const Aperture& aperture,
                                          const DirectEffort& effort, std::uint64_t key) const {
    const RayPoint normal = point.normal.cast<float>();
    if (is_below(point, normal, aperture)) return {};
    const float first = aperture.first_edge.norm(), second = aperture.second_edge.norm(),
                far = (aperture.at(0.5f, 0.5f) - point.origin).norm();
    const std::array<std::uint32_t, 2> seeds{static_cast<std::uint32_t>(key),
                                             static_cast<std::uint32_t>(key >> 32)};
    const bool are_many = apertures_.size() > many;  // then what each misses evens out
    int count = std::clamp(
        static_cast<int>(samples_of_size * std::max(first, second) / std::max(far, 1e-6f)),
        are_many ? fewest_of_many : fewest, most_at_first);
    const int most = std::clamp(effort.most, most_at_first, most_ever);
    Through sum;
    RayBatch batch;
    LandingBatch landed;
    std::array<double, most_ever> value{};
    for (bool last = false;; last = true, count = most) {
        sum = {};
        for (int from = 0; from < count; from += ray_batch) {
            const int filled = std::min(ray_batch, count - from);
            std::array<float, ray_batch> weight{};
            for (std::size_t k = 0; k < static_cast<std::size_t>(filled); ++k) {
                const std::size_t n = static_cast<std::size_t>(from) + k;
                const RayPoint ray =
                    aperture.at(points_.at(0, n, seeds[0]), points_.at(1, n, seeds[1])) -
                    point.origin;
                const float squared = std::max(1e-14f, ray.squaredNorm());
                weight[k] = std::max(0.0f, ray.dot(normal)) * std::abs(ray.dot(aperture.normal)) *
                            aperture.area / (squared * squared * std::numbers::pi_v<float>);
                batch.ox[k] = point.origin.x(), batch.dx[k] = ray.x();
                batch.oy[k] = point.origin.y(), batch.dy[k] = ray.y();
                batch.oz[k] = point.origin.z(), batch.dz[k] = ray.z();
            }
            rays_.land(batch, filled, landed);
            for (std::size_t k = 0; k < static_cast<std::size_t>(filled); ++k) {
                double& seen = value[static_cast<std::size_t>(from) + k] = 0.0;
                if (landed.landing[k] != Landing::front || !(weight[k] > 0.0f) ||
                    landed.surface[k] >= source_of_.size() || source_of_[landed.surface[k]] == 0)
                    continue;
                const std::size_t s = source_of_[landed.surface[k]] - 1;
                if (point.clear && (*point.clear)[s]) continue;
                const RayPoint whole =
                    RayPoint(landed.x[k], landed.y[k], landed.z[k]) - point.origin;
                const RayPoint ray(batch.dx[k], batch.dy[k], batch.dz[k]);
                if (whole.squaredNorm() < (1.0f - reached) * ray.squaredNorm()) continue;
                const int crossed = std::max(1, count_crossed(apertures_, point.origin, whole));
                const Rgb arriving =
                    static_cast<double>(weight[k]) / (crossed * count) * sources_[s].exitance;
                seen = luminance(arriving);
                sum.irradiance += arriving;
            }
        }
        const double mean = luminance(sum.irradiance) / count;
        for (int n = 0; n < count; ++n)
            sum.variance += std::pow(value[static_cast<std::size_t>(n)] - mean, 2);
        sum.variance *= stratified * count / (count - 1.0);
        const bool agree = sum.variance <= std::pow(alike * mean * count, 2);
        if (last || agree || are_many || count == most) return sum;
    }
}

}  // namespace patchlight
