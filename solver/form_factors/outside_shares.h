#pragma once

#include "solver/form_factors/exchange_matrix.h"
#include "solver/form_factors/patch_clusters.h"

#include <vector>

namespace patchlight {

/// Sets the shares of backs and escapes, and how well rays know them. A patch's own hits are pooled
/// with its cluster's as far as the cluster's patches are alike (a beta prior whose strength is
/// found from the spread among them, Robbins 1956): where all see the same, each knows it from all
/// their rays; where some see nothing but backs and others none, as at the foot of a box, each
/// stands alone. `row_sums`: of a patch whose rays all met nothing, or backs alone, though the
/// other end of a pair saw it, that share is not certain to be all: it is as uncertain as that much
/// light.
void set_outside(ExchangeMatrix& matrix, const std::vector<Outside>& outside,
                 const PatchClusters& clusters, const std::vector<double>& row_sums);

}  // namespace patchlight
