#include "solver/accuracy/sensor_light.h"

#include "solver/accuracy/judge.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t sensors_together = 16;
constexpr float clear_of_contact = 1.2f;  // of the contact distance: above what touches the sensor
constexpr std::size_t parts = 4;          // gathered apart: what they differ by is their noise
/// Half of Student's t of three degrees of freedom, beyond which 5 % lie: within two errors are
/// 95 %.
constexpr double of_standard_error = 3.182 / 2.0;
constexpr DirectEffort few_samples{16, 64};
constexpr double share_of_rays = 0.05;  // of those of vertices, sensors may take
/// Of a part. Beyond it what the field is wrong by is more than noise: a point below a table varies
/// by 4e-4 from seed to seed, by 2e-3 with an eighth of them.
constexpr int enough_rays = 8192;
constexpr int fewest_rays = 512, most_rays = 1 << 15;

struct SensorLight {
    const Scene& scene;
    const RayScene& rays;
    const PointGather& gather;
    const ReflectedField& field;
    const SensorEffort& effort;
    std::vector<bool> is_listed;  // surfaces that are gathered from one by one

    SensorReport at(const Sensor& sensor, std::size_t number, const SensorEffort& with) const;
    double missed_by_field(const GatherPoint& sensor, std::uint64_t key) const;
    double missed_at(const RayPoint& at, SurfaceIndex s, std::uint64_t key) const;
};

/// By how much the field at a point is off what arrives there, sent on: luminance [W/m²].
double SensorLight::missed_at(const RayPoint& at, SurfaceIndex s, std::uint64_t key) const {
    const ReflectedField::Seen seen = field.at(s, at.x(), at.y(), at.z());
    const Surface& surface = scene.surfaces[s];
    const Material& material = scene.materials[surface.material];
    const FrameIndex frame = rays.frame(s);
    const GatherPoint point = gather.at(rays.from_ray_space(at.cast<double>(), frame),
                                        surface.normal, rays.lift(s), frame);
    Rgb anew = material.reflectance *
               (gather.direct(point, few_samples, mix(key, 1)).irradiance +
                gather.indirect(point, field, effort.rays_of_look, mix(key, 2)).irradiance);
    if (!is_listed[s]) anew += material.exitance;
    const Rgb shown =
        Eigen::Array3f(seen.radiosity[0], seen.radiosity[1], seen.radiosity[2]).cast<double>();
    return luminance(shown - anew);
}

/// What the field is wrong by as the sensor sees it, by a look at a few places, luminance [W/m²].
/// A dark corner is hardly a share of the error of the whole field, but may be all that a sensor
/// sees.
double SensorLight::missed_by_field(const GatherPoint& sensor, std::uint64_t key) const {
    RayBatch batch;
    batch.ox.fill(sensor.origin.x());
    batch.oy.fill(sensor.origin.y());
    batch.oz.fill(sensor.origin.z());
    batch.frame.fill(sensor.frame);
    std::array<Lanes, 2> u;
    for (std::size_t k = 0; k < ray_batch; ++k) {  // four by four strata
        u[0][k] = (static_cast<float>(k % 4) + static_cast<float>(unit(mix(key, 2 * k)))) / 4.0f;
        u[1][k] =
            (static_cast<float>(k / 4) + static_cast<float>(unit(mix(key, 2 * k + 1)))) / 4.0f;
    }
    cosine_directions(frame_about(sensor.normal.cast<float>()), u[0], u[1], batch);
    LandingBatch landings;
    rays.land(batch, ray_batch, landings);
    std::array<double, ray_batch> missed{};
    for (std::size_t k = 0; k < ray_batch; ++k)
        if (landings.landing[k] == Landing::front)
            missed[k] = missed_at({landings.x[k], landings.y[k], landings.z[k]},
                                  landings.surface[k], mix(key, 100 + k));
    double mean = 0.0, square = 0.0;
    for (const double m : missed) mean += m / ray_batch;
    for (const double m : missed) square += (m - mean) * (m - mean);
    const double noise = square / (ray_batch * (ray_batch - 1));  // of the mean, squared
    return std::sqrt(std::max(0.0, mean * mean - noise));
}

SensorReport SensorLight::at(const Sensor& sensor, std::size_t number,
                             const SensorEffort& with) const {
    const FrameIndex frame = rays.frame_at(sensor.position);
    const GatherPoint point =
        gather.at(sensor.position, sensor.normal,
                  clear_of_contact * rays.contact_at(sensor.position, frame), frame);
    SensorReport report;
    std::array<double, parts> seen{};
    for (std::size_t part = 0; part < parts; ++part) {
        const std::uint64_t key = mix(effort.seed, parts * number + part);
        const Rgb indirect = gather.indirect(point, field, with.rays, mix(key, 1)).irradiance;
        const Rgb sum = gather.direct(point, with.direct, key).irradiance + indirect;
        seen[part] = luminance(sum);
        report.irradiance += sum / static_cast<double>(parts);
        report.reflected += luminance(indirect) / static_cast<double>(parts);
    }
    const double mean = luminance(report.irradiance);
    double squares = 0.0;
    for (const double part : seen) squares += (part - mean) * (part - mean);
    const double noise = of_standard_error * std::sqrt(squares / (parts * (parts - 1)));
    report.error = noise;
    if (with.rays_of_look > 0)
        report.error =
            std::hypot(noise, passed_on * missed_by_field(point, mix(effort.seed, ~number)));
    return report;
}

SensorEffort in_a_hurry(SensorEffort effort) {
    effort.direct = few_samples;
    effort.rays = ray_batch * 2;
    effort.rays_of_look = 0;
    return effort;
}

}  // namespace

SensorEffort sensor_effort(const GatherAim& aim, double rays_of_vertices, std::size_t sensors,
                           std::uint64_t seed) {
    SensorEffort effort;
    effort.direct.bright = aim.effort.bright;
    const double affordable = share_of_rays * rays_of_vertices / static_cast<double>(parts) /
                              static_cast<double>(std::max<std::size_t>(sensors, 1));
    const int as_vertices = std::clamp(2 * aim.rays, fewest_rays, most_rays);
    effort.rays = std::max(as_vertices,
                           static_cast<int>(std::min<double>(affordable, enough_rays)) / 32 * 32);
    effort.rays_of_look = std::max(64, aim.rays / 128 * 32);
    effort.seed = seed;
    return effort;
}

std::vector<SensorReport> light_at_sensors(const Scene& scene, const RayScene& rays,
                                           const PointGather& gather, const ReflectedField& field,
                                           const SensorEffort& effort,
                                           const std::function<bool(double)>& go_on) {
    SensorLight light{scene, rays,   gather,
                      field, effort, std::vector<bool>(scene.surfaces.size(), false)};
    for (const LightSource& source : gather.sources()) light.is_listed[source.surface] = true;
    std::vector<SensorReport> reports(scene.sensors.size());
    for (std::size_t first = 0; first < reports.size(); first += sensors_together) {
        const std::size_t end = std::min(first + sensors_together, reports.size());
        tbb::parallel_for(
            first, end, [&](std::size_t s) { reports[s] = light.at(scene.sensors[s], s, effort); });
        const double done = static_cast<double>(end) / static_cast<double>(reports.size());
        if (!go_on || go_on(done)) continue;
        tbb::parallel_for(end, reports.size(), [&](std::size_t s) {
            reports[s] = light.at(scene.sensors[s], s, in_a_hurry(effort));
        });
        break;
    }
    return reports;
}

}  // namespace patchlight
