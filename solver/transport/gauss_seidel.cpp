#include "solver/transport/gauss_seidel.h"

#include "solver/scene/input_error.h"
#include "solver/transport/conjugate_gradients.h"
#include "solver/transport/gather.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>

namespace patchlight {

namespace {

constexpr PatchIndex block = 128;  // rows that gather together; inside it the sweep is sequential
constexpr int trial_sweeps = 4;    // before their pace is judged
constexpr int steps_to_restart =
    50;  // of conjugate gradients, before the true residual is taken up
constexpr double most_sweeps_ahead =
    16.0;  // more than these to go: conjugate gradients are quicker

/// Sweeps still to go at the pace of the last one.
double sweeps_ahead(double before, double now, const std::optional<double>& bound,
                    double tolerance) {
    const double factor = now / before;
    if (!(factor < 1.0)) return std::numeric_limits<double>::infinity();
    const double gap = bound ? *bound / tolerance : 1.0 / tolerance;
    return std::log(std::max(gap, 1.0)) / -std::log(factor);
}

}  // namespace

void gauss_seidel_sweep(const RadiosityProblem& problem, Field& radiosity) {
    const auto n = static_cast<PatchIndex>(problem.size());
    std::array<Gathered, block> outside;
    for (PatchIndex first = 0; first < n; first += block) {
        const PatchIndex last = std::min(n, first + block);
        for_rows_together(first, last, [&](PatchIndex begin, PatchIndex end) {
            const auto before = gather_some(problem.factors, begin, end, radiosity, 0, first);
            const auto after = gather_some(problem.factors, begin, end, radiosity, last, n);
            for (PatchIndex i = begin; i < end; ++i)
                for (std::size_t c = 0; c < problem.channels(); ++c)
                    outside[i - first][c] = before[i - begin][c] + after[i - begin][c];
        });
        for (PatchIndex i = first; i < last; ++i) {
            const Gathered inside = gather(problem.factors, i, radiosity, first, last);
            for (std::size_t c = 0; c < problem.channels(); ++c)
                radiosity[c][i] = problem.exitance[c][i] +
                                  problem.reflectance[c][i] * (outside[i - first][c] + inside[c]);
        }
    }
}

SolveReport solve_gauss_seidel(const RadiosityProblem& problem, const StopRule& stop) {
    const double q = contraction(problem);
    if (q >= 1.0)
        throw InputError(
            "/materials",
            "largest reflectance times row sum is " + std::to_string(q) +
                ": light never dies out (near-singular); lower the reflectance below 1");
    const auto start = std::chrono::steady_clock::now();
    SolveReport report;
    report.radiosity = problem.exitance;
    report.residual = measure_residual(problem, report.radiosity);
    const auto step_done = [&](int iteration) {
        report.residual = measure_residual(problem, report.radiosity);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        report.convergence.push_back({iteration, seconds, report.residual.relative});
        const auto& bound = report.residual.algebraic_bound;
        report.stopped_by =
            bound && *bound <= stop.tolerance ? StopReason::tolerance : StopReason::iteration_limit;
        if (report.stopped_by == StopReason::tolerance) return true;
        if (!stop.observe) return false;
        if (stop.show) stop.show(report.radiosity);
        const StopReason told = stop.observe(iteration, report.residual.relative);
        if (told != StopReason::tolerance) report.stopped_by = told;
        return told != StopReason::tolerance;
    };
    for (int iteration = 1; iteration <= stop.max_iterations; ++iteration) {
        const double before = report.residual.relative;
        gauss_seidel_sweep(problem, report.radiosity);
        if (step_done(iteration)) return report;
        if (iteration < trial_sweeps) continue;
        if (sweeps_ahead(before, report.residual.relative, report.residual.algebraic_bound,
                         stop.tolerance) < most_sweeps_ahead)
            continue;
        report.used_conjugate_gradients = true;
        ConjugateGradients gradients(problem, report.residual.residual);
        for (int step = 0; step < steps_to_restart && iteration < stop.max_iterations; ++step) {
            if (!gradients.step(report.radiosity)) break;  // rounding is all that is left
            if (step_done(++iteration)) return report;
        }
    }
    return report;
}

}  // namespace patchlight
