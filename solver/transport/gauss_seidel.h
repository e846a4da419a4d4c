#pragma once

#include "solver/transport/stop_rule.h"

namespace patchlight {

/// Solves B = E + ρ F B by Gauss–Seidel sweeps over stored rows, all channels in one pass over the
/// matrix. Stops on the algebraic bound, which is measured after each sweep, not on the change,
/// which understates the error. Where sweeps crawl (ρ near 1) conjugate gradients on the
/// symmetrised system take over (Hestenes & Stiefel, 1952). Throws InputError("/materials") if ρ
/// times a row sum reaches 1: light would never die out.
SolveReport solve_gauss_seidel(const RadiosityProblem& problem, const StopRule& stop);

/// One sweep in place: B_i = E_i + ρ_i Σ_j F_ij B_j, for i ascending. Blocks of rows first gather
/// from outside their block in parallel, which changes nothing: the result is that of a sequential
/// sweep.
void gauss_seidel_sweep(const RadiosityProblem& problem, Field& radiosity);

}  // namespace patchlight
