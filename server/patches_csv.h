#pragma once

#include "server/text_sink.h"
#include "solver/solution.h"

namespace patchlight::server {

/// A row for each patch, by the index that form factors know it by: object, material, side
/// (`front`, or `back` for the second half of a two-sided polygon), centroid [m], unit normal,
/// area [m²], and exitance, radiosity and irradiance per channel [W/m², or lm/m² and lx].
void write_patches_csv(const Scene& scene, const Solution& solution, const TextSink& sink);

}  // namespace patchlight::server
