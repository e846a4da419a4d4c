#pragma once

#include "solver/transport/radiosity_problem.h"

namespace patchlight {

/// Conjugate gradients on (A/ρ − H) B = A E / ρ, symmetric and positive definite for ρ < 1, with
/// A/ρ as preconditioner; each channel on its own, all in one pass over the matrix. Patches with ρ
/// = 0 keep the B = E they have.
class ConjugateGradients {
  public:
    /// `residual`: E + ρ F B − B of the field that `step` will be handed.
    ConjugateGradients(const RadiosityProblem& problem, Field residual);

    /// One step; false if no channel can improve.
    bool step(Field& radiosity);

  private:
    double product(std::size_t c, const std::vector<double>& a, const std::vector<double>& b) const;

    const RadiosityProblem& problem_;
    Field residual_, direction_;
    std::vector<double> energy_;  // residual · residual in the norm of A/ρ, per channel
};

}  // namespace patchlight
