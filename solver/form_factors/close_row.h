#pragma once

#include "solver/form_factors/form_factor_engine.h"

namespace patchlight {

/// Makes one row obey closure, Σ F_ij + backs + escaped = 1, for a solver that keeps no matrix: the
/// deficit goes to the entries and shares that rays measured, in proportion to their variance, the
/// least sum of squared changes over variances. Exact entries stay; none falls below 0 or rises
/// above its ceiling, and what rays counted above it is cut to it. Asks the engine where the light
/// goes that meets no front, if the row does not say and is not known to see fronts alone. Returns
/// those shares.
Outside close_row(const FormFactorEngine& engine, PatchIndex i, FactorRow& row);

}  // namespace patchlight
