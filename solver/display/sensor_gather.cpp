#include "solver/display/sensor_gather.h"

#include "solver/form_factors/point_factor.h"
#include "solver/mesh/make_patches.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/rays/patch_sampler.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr int fewest_samples = 4;  // of a patch that a sensor sees
constexpr int most_samples = 4096;
constexpr double total_samples = 4096.0;  // of a sensor, shared by what patches contribute
constexpr int penumbra_effort = 16;       // times as many where the first samples disagree
constexpr float off_contact =
    1.2f;  // of the contact distance, the start above what touches the sensor

struct Target {  // a patch as a sensor sees it
    PatchIndex patch = 0;
    double factor = 0.0;  // unoccluded [1]
    float clear_weight = 0.0f, weight = 0.0f;
    int clear = 0, taken = 0;
};

struct SensorView {
    const Sensor& sensor;
    const RayScene& ray_scene;
    const SobolPoints& points;
    RayPoint origin, normal;

    /// Samples [first, first + count) of one patch.
    void sample(Target& target, const PatchSampler& sampler, float lift, std::uint64_t key,
                int first, int count) const {
        const std::array<std::uint32_t, 2> seeds{static_cast<std::uint32_t>(key),
                                                 static_cast<std::uint32_t>(key >> 32)};
        RayBatch batch;
        std::array<float, ray_batch> weights;
        int filled = 0;
        const auto trace = [&] {
            const std::uint32_t blocked = ray_scene.blocked(batch, filled);
            for (int k = 0; k < filled; ++k) {
                target.weight += weights[k];
                ++target.taken;
                if ((blocked >> k) & 1u) continue;
                target.clear_weight += weights[k];
                ++target.clear;
            }
            filled = 0;
        };
        for (int n = first; n < first + count; ++n) {
            const auto at = static_cast<std::size_t>(n);
            const RayPoint to = sampler.at(points.at(0, at, seeds[0]), points.at(1, at, seeds[1])) +
                                lift * sampler.normal;
            const RayPoint ray = to - origin;
            const float squared = ray.squaredNorm();
            const float weight = std::max(0.0f, ray.dot(normal)) *
                                 std::max(0.0f, -ray.dot(sampler.normal)) / (squared * squared);
            if (!(weight > 0.0f)) continue;
            batch.ox[filled] = origin.x(), batch.oy[filled] = origin.y(),
            batch.oz[filled] = origin.z();
            batch.dx[filled] = ray.x(), batch.dy[filled] = ray.y(), batch.dz[filled] = ray.z();
            weights[filled++] = weight;
            if (filled == ray_batch) trace();
        }
        if (filled > 0) trace();
    }
};

struct Patches {
    std::vector<ConvexPolygon> polygons;
    std::vector<PatchSampler> samplers;
};

SensorReport gather(const Scene& scene, const PatchMesh& mesh, const Patches& patches,
                    const SensorView& view, const std::vector<Rgb>& radiosity, std::uint64_t key) {
    std::vector<Target> targets;
    double total = 0.0;
    for (PatchIndex j = 0; j < mesh.size(); ++j) {
        if (mesh.patches[j].covered || !(radiosity[j] > 0.0).any()) continue;
        const Vec3& normal = scene.surfaces[mesh.patches[j].surface].normal;
        const double factor =
            point_factor(view.sensor.position, view.sensor.normal, patches.polygons[j], normal);
        if (!(factor > 0.0)) continue;
        targets.push_back({j, factor});
        total += factor * luminance(radiosity[j]);
    }
    SensorReport report;
    double variance = 0.0;
    for (Target& target : targets) {
        const double brightness = luminance(radiosity[target.patch]);
        const double share = target.factor * brightness / total;
        const int count = std::clamp(static_cast<int>(std::lround(total_samples * share)),
                                     fewest_samples, most_samples / penumbra_effort);
        const PatchSampler& sampler = patches.samplers[target.patch];
        const float lift = view.ray_scene.lift(mesh.patches[target.patch].surface);
        const std::uint64_t own = mix(key, target.patch);
        view.sample(target, sampler, lift, own, 0, count);
        if (target.clear > 0 && target.clear < target.taken) {
            view.sample(target, sampler, lift, own, count, (penumbra_effort - 1) * count);
            const double clear = static_cast<double>(target.clear_weight / target.weight);
            const double deviation = target.factor * brightness;
            variance += deviation * deviation * clear * (1.0 - clear) / target.taken;
        }
        const double visibility = target.weight > 0.0f ? static_cast<double>(target.clear_weight) /
                                                             static_cast<double>(target.weight)
                                                       : 1.0;
        report.irradiance += visibility * target.factor * radiosity[target.patch];
    }
    report.error = std::sqrt(variance);
    return report;
}

}  // namespace

std::vector<SensorReport> gather_at_sensors(const Scene& scene, const PatchMesh& mesh,
                                            const RayScene& ray_scene,
                                            const std::vector<Rgb>& radiosity, std::uint64_t seed) {
    std::vector<SensorReport> reports(scene.sensors.size());
    if (scene.sensors.empty()) return reports;
    Patches patches;
    for (PatchIndex j = 0; j < mesh.size(); ++j) {
        patches.polygons.emplace_back();
        for (const Vec3& p : patch_corners(mesh, j)) patches.polygons.back().add(p);
        patches.samplers.push_back(
            make_sampler(mesh, j, scene.surfaces[mesh.patches[j].surface].normal, ray_scene));
    }
    const SobolPoints points(most_samples);
    tbb::parallel_for(std::size_t{0}, scene.sensors.size(), [&](std::size_t s) {
        const Sensor& sensor = scene.sensors[s];
        SensorView view{sensor, ray_scene, points, {}, sensor.normal.cast<float>()};
        view.origin = ray_scene.to_ray_space(sensor.position) +
                      off_contact * ray_scene.contact() * view.normal;
        reports[s] = gather(scene, mesh, patches, view, radiosity, mix(seed, 0x73656e73 + s));
    });
    return reports;
}

}  // namespace patchlight
