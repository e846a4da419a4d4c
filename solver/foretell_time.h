#pragma once

#include "solver/scene/scene.h"
#include "solver/settings.h"

namespace patchlight {

/// Seconds that a solve would take on this machine, with the threads that are set, usually within
/// three times: it is tried for two seconds. What ends by then takes what it took; form factors and
/// residuals go on as they began. An accuracy that was not reached is tried less tight for about
/// four seconds more, and the display takes longer as those of other scenes did. Of more
/// than 100,000 patches the time is guessed from their number. Throws what solve_scene does.
double foretell_seconds(const Scene& scene, const SolveSettings& settings);

}  // namespace patchlight
