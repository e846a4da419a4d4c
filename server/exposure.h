#pragma once

#include "solver/scene/scene.h"
#include "solver/solution.h"

namespace patchlight::server {

/// The exposure a picture gets when none is asked for: EV = log2(0.3 / L*), with
/// L* = ∫L²dA / ∫L dA over reflected luminance L = Y(B − E) / π. Taken from the solution and not
/// from a view, so that all views of it match. 0 if nothing reflects [stops].
double automatic_exposure(const Scene& scene, const Solution& solution);

}  // namespace patchlight::server
