#pragma once

#include "solver/transport/radiosity_problem.h"

#include <array>
#include <functional>

namespace patchlight {

using Gathered = std::array<double, 3>;  // a sum per channel in use

/// Σ F_ij B_j over the columns j of row i in [begin, end), for each channel. The sum runs in eight
/// interleaved parts in a fixed order: the same bytes each time.
Gathered gather(const FormFactorMatrix& factors, PatchIndex i, const Field& radiosity,
                PatchIndex begin, PatchIndex end);

constexpr PatchIndex rows_together = 4;

/// The same for rows i up to `last`, at most rows_together of them: dense rows side by side, so
/// that radiosity is read once for all of them and the matrix streams at the pace of memory.
std::array<Gathered, rows_together> gather_some(const FormFactorMatrix& factors, PatchIndex i,
                                                PatchIndex last, const Field& radiosity,
                                                PatchIndex begin, PatchIndex end);

/// Calls visit(first, last) in parallel for consecutive groups of rows_together rows.
void for_rows_together(PatchIndex first, PatchIndex last,
                       const std::function<void(PatchIndex, PatchIndex)>& visit);

/// Irradiance F B on all patches, rows in parallel [W/m²].
Field gather_all(const FormFactorMatrix& factors, const Field& radiosity);

}  // namespace patchlight
