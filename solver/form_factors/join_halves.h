#pragma once

#include "solver/form_factors/exchange_matrix.h"

#include <optional>

namespace patchlight {

/// Defects of full rows (both halves of each pair present), as an engine gave them.
ClosureReport measure_rows(const ExchangeMatrix& full_rows,
                           const std::vector<std::optional<Outside>>& outside);

/// Joins full rows into the upper triangle. Both ends of a pair cast equally many rays, so the hits
/// of both are pooled: H = (F_ij + F_ji) / (1/A_i + 1/A_j), the most likely value and, for equal
/// areas, of half the variance.
void join_halves(ExchangeMatrix& matrix);

}  // namespace patchlight
