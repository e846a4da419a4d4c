#pragma once

#include "solver/accuracy/gathered_light.h"
#include "solver/solution.h"

#include <functional>
#include <vector>

namespace patchlight {

/// Of each of four parts that are gathered apart.
struct SensorEffort {
    DirectEffort direct{32, 2048};
    int rays = 2048;         // over the hemisphere, a multiple of 32
    int rays_of_look = 256;  // at each of 16 places that the sensor sees, likewise; 0: at none
    std::uint64_t seed = 0;
};

/// As fine as vertices were gathered, or finer: all sensors may take a twentieth of the rays that
/// vertices took.
SensorEffort sensor_effort(const GatherAim& aim, double rays_of_vertices, std::size_t sensors,
                           std::uint64_t seed);

/// Irradiance at each sensor: straight from sources, and by rays from the field. What its parts
/// differ by tells the noise. `go_on` is told the fraction done now and then; after a false the
/// rest of the sensors is lit by few rays, and what the field is wrong by is not among their
/// errors.
std::vector<SensorReport> light_at_sensors(const Scene& scene, const RayScene& rays,
                                           const PointGather& gather, const ReflectedField& field,
                                           const SensorEffort& effort,
                                           const std::function<bool(double)>& go_on);

}  // namespace patchlight
