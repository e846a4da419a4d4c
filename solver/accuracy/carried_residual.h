#pragma once

#include "solver/accuracy/check_points.h"
#include "solver/accuracy/energy.h"

#include <cstdint>

namespace patchlight {

/// What the residual at check points comes to once it has gone round, √∫ Y² dA [W/m]: the error of
/// the indirect light. With the residual r and the transport K of the radiosity equation it is
/// Σ Kⁿ r. K is applied from point to point by rays: what one of them lands on is wrong as the
/// nearest point of that object is. That holds where wrong neighbours light each other, as in the
/// gap between a lamp and its ceiling, which patches may be too coarse to tell of. What is wrong
/// alike everywhere takes many bounces, and is known better from the energy that is missing.
/// Two estimates from the two halves of the residual and rays of their own: their product has no
/// share of their noise in the mean.
MeasuredError carried_residual(const Scene& scene, const RayScene& rays, const CheckReport& checks,
                               const EnergyReport& energy, std::uint64_t seed);

}  // namespace patchlight
