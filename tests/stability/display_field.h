#pragma once

#include "solver/solution.h"

#include <optional>

namespace patchlight::stability {

/// The displayed radiosity, first channel, at a point of surface s; none where no triangle of it
/// holds the point [W/m²].
std::optional<double> shown_at(const Solution& solution, SurfaceIndex s, const Vec3& point);

}  // namespace patchlight::stability
