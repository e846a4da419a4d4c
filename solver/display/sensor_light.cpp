#include "solver/display/sensor_light.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace patchlight {

namespace {

constexpr std::size_t sensors_together = 64;
constexpr float clear_of_contact = 1.2f;  // of the contact distance: above what touches the sensor
constexpr std::size_t parts = 4;          // gathered apart: what they differ by is their noise
/// Half of Student's t of three degrees of freedom, beyond which 5 % lie: within two errors are
/// 95 %.
constexpr double of_standard_error = 3.182 / 2.0;

SensorReport light_at(const Sensor& sensor, std::size_t number, const RayScene& rays,
                      const PointGather& gather, const ReflectedField& field,
                      const SensorEffort& effort) {
    const FrameIndex frame = rays.frame_at(sensor.position);
    const GatherPoint point =
        gather.at(sensor.position, sensor.normal,
                  clear_of_contact * rays.contact_at(sensor.position, frame), frame);
    SensorReport report;
    std::array<double, parts> seen{};
    for (std::size_t part = 0; part < parts; ++part) {
        const std::uint64_t key = mix(effort.seed, parts * number + part);
        const Rgb indirect = gather.indirect(point, field, effort.rays, mix(key, 1)).irradiance;
        const Rgb sum = gather.direct(point, effort.direct, key).irradiance + indirect;
        seen[part] = luminance(sum);
        report.irradiance += sum / static_cast<double>(parts);
        report.reflected += luminance(indirect) / static_cast<double>(parts);
    }
    const double mean = luminance(report.irradiance);
    double squares = 0.0;
    for (const double part : seen) squares += (part - mean) * (part - mean);
    report.error = of_standard_error * std::sqrt(squares / (parts * (parts - 1)));
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
