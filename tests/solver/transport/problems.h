#pragma once

#include "solver/transport/radiosity_problem.h"

#include <memory>

namespace patchlight {

/// A problem and the matrix it refers to.
struct OwnedProblem {
    OwnedProblem(const ExchangeMatrix& exchange, std::size_t channels);
    OwnedProblem(const OwnedProblem&) = delete;
    OwnedProblem& operator=(const OwnedProblem&) = delete;

    FormFactorMatrix factors;
    RadiosityProblem problem;  // ρ = 0.5, E = 0 until set
};

/// Every patch sees every other alike: F_ij = 1 / (n - 1).
ExchangeMatrix uniform_exchange(std::size_t n);

/// A random closed scene with random ρ up to `most` and light on some patches.
std::unique_ptr<OwnedProblem> random_problem(std::size_t n, double filled, std::size_t channels,
                                             double most, unsigned seed);

/// B = (I − ρF)⁻¹ E by a dense factorisation.
Field solve_directly(const RadiosityProblem& problem);

/// ‖Y(B − exact)‖ / ‖Y(exact − E)‖ in the area-weighted 2-norm [1].
double relative_error(const RadiosityProblem& problem, const Field& radiosity, const Field& exact);

/// Largest |a − b| over the largest |b| [1].
double largest_difference(const Field& a, const Field& b);

}  // namespace patchlight
