#pragma once

#include "solver/solution.h"
#include "solver/transport/residual.h"

#include <functional>
#include <vector>

namespace patchlight {

enum class StopReason : std::uint8_t { tolerance, iteration_limit, time_limit, cancelled };

struct StopRule {
    double tolerance = 1e-4;  // of the algebraic bound [1]
    int max_iterations = 1000;
    /// Called after each iteration, if given; what it answers other than `tolerance` stops the
    /// work.
    std::function<StopReason(int iteration, double residual)> observe;
    /// Handed B before each of those calls, if given.
    std::function<void(const Field& radiosity)> show = nullptr;
};

struct SolveReport {
    Field radiosity;    // B [W/m²]
    Residual residual;  // of that B
    std::vector<ConvergenceStep> convergence;
    StopReason stopped_by = StopReason::iteration_limit;
    bool used_conjugate_gradients = false;
};

}  // namespace patchlight
