#pragma once

#include "solver/accuracy/outside_flux.h"
#include "solver/form_factors/exchange_matrix.h"
#include "solver/solution.h"

#include <vector>

namespace patchlight {

/// Where the light went: emitted Σ A E, absorbed Σ A (1 − ρ) H; what went to backs and out of the
/// scene is given [W].
EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh, const Rgb& backs,
                            const Rgb& escaped, const std::vector<Rgb>& irradiance);

/// The same with Σ A B times shares of backs and escapes, given or as the matrix states them.
EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh,
                            const std::vector<double>& backs, const std::vector<double>& escaped,
                            const std::vector<Rgb>& radiosity, const std::vector<Rgb>& irradiance);
EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh,
                            const ExchangeMatrix& exchange, const std::vector<Rgb>& radiosity,
                            const std::vector<Rgb>& irradiance);

/// The same of a displayed field, whose light that goes astray was counted by rays.
EnergyReport measure_energy(const Scene& scene, const PatchMesh& mesh, const OutsideFlux& outside,
                            const std::vector<Rgb>& irradiance);

/// The least relative error of a field that misses so much light, two standard errors taken off:
/// ∫ H̃ - H over the fronts is known, and by Cauchy and Schwarz no field of a smaller norm has it:
/// missing / (‖(1 - ρ)/ρ + escaped + backs‖ ‖B̃ - E‖) with ‖x‖ = √ΣA x², of the channels with all
/// ρ > 0 the largest [1]. `backs`, `escaped`: shares of each patch's light [1].
double error_proven_by_energy(const Scene& scene, const PatchMesh& mesh, const EnergyReport& energy,
                              const std::vector<Rgb>& irradiance, const std::vector<double>& backs,
                              const std::vector<double>& escaped);

/// Area means of each object, its emitted power, and the range of its display field.
std::vector<ObjectReport> measure_objects(const Scene& scene, const Solution& solution);

}  // namespace patchlight
