#include "solver/display/sensor_light.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t sensors_together = 64;
constexpr float clear_of_contact = 1.2f;  // of the contact distance: above what touches the sensor

SensorReport light_at(const Sensor& sensor, std::size_t number, const RayScene& rays,
                      const PointGather& gather, const ReflectedField& field,
                      const SensorEffort& effort) {
    const FrameIndex frame = rays.frame_at(sensor.position);
    const GatherPoint point =
        gather.at(sensor.position, sensor.normal,
                  clear_of_contact * rays.contact_at(sensor.position, frame), frame);
    std::array<Rgb, 2> sum{}, indirect{};
    for (std::size_t half = 0; half < 2; ++half) {
        const std::uint64_t key = mix(effort.seed, 2 * number + half);
        indirect[half] = gather.indirect(point, field, effort.rays, mix(key, 1)).irradiance;
        sum[half] = gather.direct(point, effort.direct, key).irradiance + indirect[half];
    }
    SensorReport report;
    report.irradiance = 0.5 * (sum[0] + sum[1]);
    const double noise = 0.5 * std::abs(luminance(sum[0] - sum[1])),
                 passed_on = effort.field_error * 0.5 * luminance(indirect[0] + indirect[1]);
    report.error = std::hypot(noise, passed_on);
    return report;
}

}  // namespace

std::vector<SensorReport> light_at_sensors(const Scene& scene, const RayScene& rays,
                                           const PointGather& gather, const ReflectedField& field,
                                           const SensorEffort& effort,
                                           const std::function<bool(double)>& go_on) {
    std::vector<SensorReport> reports(scene.sensors.size());
    for (std::size_t first = 0; first < reports.size(); first += sensors_together) {
        const std::size_t end = std::min(first + sensors_together, reports.size());
        tbb::parallel_for(first, end, [&](std::size_t s) {
            reports[s] = light_at(scene.sensors[s], s, rays, gather, field, effort);
        });
        const double done = static_cast<double>(end) / static_cast<double>(reports.size());
        if (go_on && !go_on(done)) reports.resize(end);
    }
    return reports;
}

}  // namespace patchlight
