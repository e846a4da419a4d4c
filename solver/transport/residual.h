#pragma once

#include "solver/transport/radiosity_problem.h"

#include <optional>

namespace patchlight {

/// What is still wrong with a radiosity field, told by the matrix alone.
struct Residual {
    Field irradiance;       // F B [W/m²]
    Field residual;         // r = E + ρ F B − B [W/m²]
    double relative = 0.0;  // largest ‖r_c‖ / ‖E_c‖ over channels, ‖x‖ = √(Σ A x²) [1]
    /// Rigorous bound of the relative error of B against the exact solution for this matrix:
    /// b = Σ w_c ‖r_c‖ / (1 − q_c) over (‖Y(B − E)‖ − b), q_c = max ρ_c · max row sum; absent while
    /// that is not positive. Valid as A_i F_ij is symmetric.
    std::optional<double> algebraic_bound;
};

Residual measure_residual(const RadiosityProblem& problem, const Field& radiosity);

/// Largest q_c = max ρ_c · max row sum: below 1, or the light never dies out [1].
double contraction(const RadiosityProblem& problem);

}  // namespace patchlight
