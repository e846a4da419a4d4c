#pragma once

#include "solver/form_factors/exchange_matrix.h"

#include <random>
#include <vector>

namespace patchlight {

/// A matrix without entries, all of whose light is unaccounted for.
ExchangeMatrix empty_matrix(const std::vector<double>& areas);
/// Entries must come by rows, columns ascending, j > i.
void add_entry(ExchangeMatrix& matrix, PatchIndex i, PatchIndex j, double exchange,
               double variance = 0.0, double ceiling = 1e9);
/// Ends the rows up to the last.
void finish(ExchangeMatrix& matrix);

/// A random symmetric matrix whose rows sum to 1; `filled`: the share of pairs that see each other.
ExchangeMatrix random_closed(std::size_t n, double filled, unsigned seed);

double row_sum(const ExchangeMatrix& matrix, PatchIndex i);

}  // namespace patchlight
