#include "solver/display/sensor_gather.h"

#include "solver/form_factors/point_factor.h"
#include "solver/mesh/make_patches.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/rays/patch_sampler.h"
#include "solver/rays/penumbra.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t sensors_at_a_time = 64;
constexpr int fewest_samples = 4;  // of a patch that a sensor sees
constexpr int most_samples = 16384;
constexpr double total_samples = 4096.0;  // of a sensor, shared by what patches contribute
constexpr int penumbra_effort = 16;       // times as many where the first samples disagree
constexpr float off_contact =
    1.2f;  // of the contact distance, the start above what touches the sensor

struct Target {  // a patch as a sensor sees it
    PatchIndex patch = 0;
    double factor = 0.0;  // unoccluded [1]
    float clear_weight = 0.0f, weight = 0.0f;
    int clear = 0, taken = 0;
    int count = 0;  // of its first samples
};

struct SensorView {
    const Sensor& sensor;
    const RayScene& ray_scene;
    const SobolPoints& points;
    RayPoint origin, normal;
    FrameIndex frame;

    /// Samples [first, first + count) of one patch.
    void sample(Target& target, const PatchSampler& sampler, float lift, std::uint64_t key,
                int first, int count) const {
        const std::array<std::uint32_t, 2> seeds{static_cast<std::uint32_t>(key),
                                                 static_cast<std::uint32_t>(key >> 32)};
        const RayPoint shift = ray_scene.shift(sampler.frame, frame).cast<float>();
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
            const RayPoint ray = to + shift - origin;
            const float squared = ray.squaredNorm();
            const float weight = std::max(0.0f, ray.dot(normal)) / squared *
                                 (std::max(0.0f, -ray.dot(sampler.normal)) / squared);
            if (!(weight > 0.0f)) continue;
            RayScene::set_segment(batch, filled, origin, frame, ray, to, sampler.frame);
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
        targets.push_back({});
        targets.back().patch = j;
        targets.back().factor = factor;
        total += factor * luminance(radiosity[j]);
    }
    std::vector<FirstLook> looks;
    const auto sample = [&](Target& target, int first, int count) {
        const float lift = view.ray_scene.lift(mesh.patches[target.patch].surface);
        view.sample(target, patches.samplers[target.patch], lift, mix(key, target.patch), first,
                    count);
    };
    for (Target& target : targets) {
        const double share = target.factor * luminance(radiosity[target.patch]) / total;
        target.count = std::clamp(static_cast<int>(std::lround(total_samples * share)),
                                  fewest_samples, most_samples / penumbra_effort);
        sample(target, 0, target.count);
        looks.push_back({mesh.patches[target.patch].surface, target.clear, target.taken});
    }
    const std::vector<bool> chosen = in_penumbra(looks);
    SensorReport report;
    double variance = 0.0;
    for (std::size_t t = 0; t < targets.size(); ++t) {
        Target& target = targets[t];
        if (chosen[t]) sample(target, target.count, (penumbra_effort - 1) * target.count);
        const double clear =
            target.weight > 0.0f ? static_cast<double>(target.clear_weight / target.weight) : 1.0;
        report.irradiance += clear * target.factor * radiosity[target.patch];
        const Surface& surface = scene.surfaces[mesh.patches[target.patch].surface];
        report.reflected +=
            clear * target.factor *
            luminance(radiosity[target.patch] - scene.materials[surface.material].exitance);
        const double contribution = target.factor * luminance(radiosity[target.patch]);
        if (target.taken > 0)
            variance += contribution * contribution * clear * (1.0 - clear) / target.taken;
    }
    report.error = std::sqrt(variance);
    return report;
}

}  // namespace

std::vector<SensorReport> gather_at_sensors(const Scene& scene, const PatchMesh& mesh,
                                            const RayScene& ray_scene,
                                            const std::vector<Rgb>& radiosity, std::uint64_t seed,
                                            const std::function<bool(double)>& go_on) {
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
    const auto report = [&](std::size_t s) {
        const Sensor& sensor = scene.sensors[s];
        const FrameIndex frame = ray_scene.frame_at(sensor.position);
        SensorView view{sensor, ray_scene, points, {}, sensor.normal.cast<float>(), frame};
        view.origin = ray_scene.to_ray_space(sensor.position, frame) +
                      off_contact * ray_scene.contact_at(sensor.position, frame) * view.normal;
        reports[s] = gather(scene, mesh, patches, view, radiosity, mix(seed, 0x73656e73 + s));
    };
    for (std::size_t first = 0; first < reports.size(); first += sensors_at_a_time) {
        const std::size_t end = std::min(first + sensors_at_a_time, reports.size());
        tbb::parallel_for(first, end, report);
        const double done = static_cast<double>(end) / static_cast<double>(reports.size());
        if (go_on && !go_on(done)) reports.resize(end);
    }
    return reports;
}

}  // namespace patchlight
