#pragma once

#include "solver/display/point_gather.h"
#include "solver/solution.h"

#include <functional>
#include <vector>

namespace patchlight {

struct SensorEffort {
    DirectEffort direct{64, 4096};
    int rays = 4096;           // over the hemisphere, twice
    double field_error = 0.0;  // of what rays read, relative [1]
    std::uint64_t seed = 0;
};

/// Irradiance at each sensor: straight from sources, and by rays from the field. Each is gathered
/// twice, and half the difference is its noise; with what the field's error makes of the indirect
/// part that is the sensor's error. `go_on` is told the fraction done now and then; after a false
/// there are reports of the first sensors alone.
std::vector<SensorReport> light_at_sensors(const Scene& scene, const RayScene& rays,
                                           const PointGather& gather, const ReflectedField& field,
                                           const SensorEffort& effort,
                                           const std::function<bool(double)>& go_on);

}  // namespace patchlight
