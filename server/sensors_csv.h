#pragma once

#include "server/text_sink.h"
#include "solver/solution.h"

namespace patchlight::server {

/// A row for each sensor, in the scene's order, points of grids among them: name, position [m],
/// unit normal, irradiance per channel and as the scalar Y of the three, and one standard error of
/// that scalar [W/m² or lx]. Without rows if the work ended before they were gathered.
void write_sensors_csv(const Scene& scene, const Solution& solution, const TextSink& sink);

}  // namespace patchlight::server
