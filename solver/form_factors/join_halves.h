#pragma once

#include "solver/form_factors/exchange_matrix.h"

#include <optional>

namespace patchlight {

/// Defects of full rows (both halves of each pair present), as an engine gave them.
ClosureReport measure_rows(const ExchangeMatrix& full_rows,
                           const std::vector<std::optional<Outside>>& outside);

/// Joins full rows into the upper triangle. The samples n of both ends of a pair are pooled: H =
/// (n_i F_ij + n_j F_ji) / (n_i/A_i + n_j/A_j), the most likely value and, for equal areas and
/// samples, of half the variance. `samples`: of each row, up to a common factor.
void join_halves(ExchangeMatrix& matrix, const std::vector<int>& samples);

}  // namespace patchlight
