#pragma once

#include "solver/form_factors/exchange_matrix.h"
#include "solver/solution.h"

#include <vector>

namespace patchlight {

/// Where the light went: emitted Σ A E, absorbed Σ A (1 − ρ) H; what went to backs and out of the
/// scene is given [W].
EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh, const Rgb& backs,
                            const Rgb& escaped, const std::vector<Rgb>& irradiance);

/// The same with Σ A B times the shares of backs and escapes that the matrix states.
EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh,
                            const ExchangeMatrix& exchange, const std::vector<Rgb>& radiosity,
                            const std::vector<Rgb>& irradiance);

/// Area means of each object, its emitted power, and the range of its display field.
std::vector<ObjectReport> measure_objects(const Scene& scene, const Solution& solution);

}  // namespace patchlight
