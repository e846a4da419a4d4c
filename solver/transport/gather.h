#pragma once

#include "solver/transport/radiosity_problem.h"

#include <array>

namespace patchlight {

using Gathered = std::array<double, 3>;  // a sum per channel in use

/// Σ F_ij B_j over the columns j of row i in [begin, end), for each channel. The sum runs in eight
/// interleaved parts in a fixed order: the same bytes each time.
Gathered gather(const FormFactorMatrix& factors, PatchIndex i, const Field& radiosity,
                PatchIndex begin, PatchIndex end);

/// Irradiance F B on all patches, rows in parallel [W/m²].
Field gather_all(const FormFactorMatrix& factors, const Field& radiosity);

}  // namespace patchlight
