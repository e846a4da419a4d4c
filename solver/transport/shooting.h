#pragma once

#include "solver/transport/row_source.h"
#include "solver/transport/stop_rule.h"

#include <functional>
#include <vector>

namespace patchlight {

/// B = E + ρ F B without a matrix: rows come when they are asked for.
struct ShootingProblem {
    RowSource& rows;
    std::vector<double> area;  // [m²]
    Field exitance;            // E [W/m²]
    Field reflectance;         // ρ [1]

    std::size_t size() const { return area.size(); }
    std::size_t channels() const { return exitance.size(); }
};

/// The state after some shots; a lower bound of the solution on every patch.
struct ShotSoFar {
    Field radiosity;   // B: E and what has arrived and was reflected [W/m²]
    Field irradiance;  // that has arrived [W/m²]
    Field unshot;      // ΔB, the part of B that has not been sent on [W/m²]
    Field lost;        // per channel: sent to backs, sent out of the scene [W]
    int shots = 0;
    double residual = 0.0;  // largest ‖ΔB_c‖ / ‖E_c‖ over channels, ‖x‖ = √(Σ A x²) [1]
    double unshot_share = 0.0;  // Σ A ΔB / Σ A E, luminance [1]
    /// Rigorous bound of the relative error against the rows as used, in the norm Σ A |x| in which
    /// shots are bounded whether or not rows are reciprocal: b = Σ w_c ‖ΔB_c‖ q_c / (1 − q_c), q_c
    /// = max ρ_c, over (‖Y(B − E)‖ − b); absent while that is not positive.
    std::optional<double> algebraic_bound;
};

struct ShootingStop {
    double tolerance = 1e-4;  // of the algebraic bound [1]
    int max_shots = 1000000;
    /// Called after each shot; what it answers other than `tolerance` stops the work. Of shots
    /// whose rows came together, the last alone is measured: the others are told the residual and
    /// the share unshot of before, and no bound.
    std::function<StopReason(const ShotSoFar&)> observe;
};

struct ShootingReport {
    ShotSoFar state;
    std::vector<ConvergenceStep> convergence;  // first shots, then whenever some light was sent on
    StopReason stopped_by = StopReason::iteration_limit;
};

/// Progressive refinement (Cohen, Chen, Wallace & Greenberg, 1988): the patch with the most unshot
/// light A ΔB sends it to all others. Up to eight of the brightest, none below a quarter of the
/// first, have their rows computed together. Rows obey closure, so no light is made or lost.
ShootingReport shoot(const ShootingProblem& problem, const ShootingStop& stop);

}  // namespace patchlight
