#pragma once

#include "solver/form_factors/exchange_matrix.h"

namespace patchlight {

/// Makes every row obey closure, row_sum + backs + escaped = 1, by the most likely change: the
/// least sum of squared changes, each over its variance, that does. H stays symmetric, so
/// reciprocity is kept; exact entries and zeros stay; no entry rises above its ceiling or falls
/// below 0. Shares of backs and escapes that were told by rays move too, as their own variance
/// allows. With multipliers λ the change is ΔH_ij = v_ij (λ_i + λ_j), which makes a symmetric
/// positive semi-definite system of one unknown a patch, solved by conjugate gradients. Rows that
/// no such change closes are left out, and shrunk if they sum to more than 1.
void repair_closure(ExchangeMatrix& matrix);

}  // namespace patchlight
