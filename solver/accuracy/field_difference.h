#pragma once

#include "solver/accuracy/displayed_field.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace patchlight {

/// A place at which displayed fields are compared; all of them stand for the same area.
struct ComparedPoint {
    SurfaceIndex surface = 0;
    Vec3 position = Vec3::Zero();  // [m]
};

/// So many points over all that a solution displays: equal shares of the area, a low-discrepancy
/// point in each. The same whenever they are asked for. None if nothing is displayed.
std::vector<ComparedPoint> spread_points(const Solution& solution, std::size_t count);

/// Y(B − E) of the displayed field at each point [W/m²].
std::vector<double> reflected_at(const Scene& scene, const DisplayedField& field,
                                 std::span<const ComparedPoint> points);

/// √(∫ (a − b)² dA / ∫ b² dA) of values at such points; `b` is the one that is right. Absent if it
/// is 0 everywhere [1].
std::optional<double> relative_difference(std::span<const double> a, std::span<const double> b);

/// Where nothing reflects: the largest difference of scalar irradiance at a sensor, relative to the
/// largest irradiance of all; `b` is the one that is right. Absent if that is 0, there are no
/// sensors, or not all of them were reached [1].
std::optional<double> relative_difference(std::span<const SensorReport> a,
                                          std::span<const SensorReport> b);

}  // namespace patchlight
