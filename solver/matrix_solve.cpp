#include "solver/accuracy/energy.h"
#include "solver/form_factors/hemicube_errors.h"
#include "solver/form_factors/repair_closure.h"
#include "solver/make_engine.h"
#include "solver/solve_stage.h"
#include "solver/transport/gauss_seidel.h"
#include "solver/transport/patch_fields.h"

namespace patchlight {

void measure_hemicube_errors(const SolveStage& stage) {
    Solution& solution = stage.solution;
    if (!solution.settings.measure_error) return;
    const double before = stage.watch.seconds_so_far();
    solution.form_factors.hemicube = estimate_hemicube_errors(
        stage.scene, solution.mesh, stage.rays, hemicube_settings(solution.settings),
        [&] { return stage.watch.in_time(); });
    solution.seconds.measuring += stage.watch.seconds_so_far() - before;
}

bool find_form_factors(const SolveStage& stage, ExchangeMatrix& exchange) {
    Solution& solution = stage.solution;
    const auto engine = make_engine(stage.scene, solution.mesh, stage.rays, solution.settings,
                                    [&] { return stage.watch.may_prepare(); });
    engine->give_up_unless([&] { return stage.watch.in_time(); });
    StopReason stopped = StopReason::tolerance;
    exchange = build_exchange(*engine, stage.scene, solution.mesh, [&](double fraction) {
        stopped = stage.watch.step({Stage::form_factors, fraction, 0, 0.0});
        return stopped == StopReason::tolerance;
    });
    solution.form_factors.rays = exchange.rays;
    if (!exchange.complete) {
        solution.status = status_of(stopped);
        return false;
    }
    solution.form_factors.measured = exchange.measured;
    repair_closure(exchange);
    solution.form_factors.repaired = measure_closure(exchange);
    if (solution.settings.engine == Engine::hemicube) measure_hemicube_errors(stage);
    return true;
}

namespace {

void solve_matrix(const SolveStage& stage, ExchangeMatrix& exchange) {
    Solution& solution = stage.solution;
    const FormFactorMatrix factors(exchange);
    std::vector<float>().swap(exchange.exchange);
    std::vector<float>().swap(exchange.variance);
    std::vector<float>().swap(exchange.ceiling);
    std::vector<PatchIndex>().swap(exchange.column);
    solution.seconds.form_factors = stage.watch.lap();
    PatchFields fields = make_patch_fields(stage.scene, solution.mesh);
    const RadiosityProblem problem{factors, std::move(fields.area), std::move(fields.exitance),
                                   std::move(fields.reflectance)};
    StopRule stop{*solution.settings.tolerance, *solution.settings.max_iterations, {}};
    const Field* so_far = nullptr;
    stop.show = [&](const Field& radiosity) { so_far = &radiosity; };
    const std::function<DisplayMesh()> picture = [&] {
        solution.radiosity = to_rgb(*so_far);
        return display_of(stage, {exchange.backs, {}});
    };
    stop.observe = [&](int iteration, double residual) {
        Progress progress{Stage::solve, 0.0, iteration, residual};
        progress.picture = &picture;
        return stage.watch.step(progress);
    };
    SolveReport report = solve_gauss_seidel(problem, stop);
    solution.radiosity = to_rgb(report.radiosity);
    solution.irradiance = to_rgb(report.residual.irradiance);
    solution.convergence = std::move(report.convergence);
    solution.error.algebraic_bound = report.residual.algebraic_bound;
    solution.within_tolerance = report.stopped_by == StopReason::tolerance;
    solution.status = status_of(report.stopped_by);
    if (report.used_conjugate_gradients)
        solution.why += " Sweeps crawled, so conjugate gradients took over.";
}

}  // namespace

DisplayHints solve_on_matrix(const SolveStage& stage) {
    Solution& solution = stage.solution;
    ExchangeMatrix exchange;
    if (!find_form_factors(stage, exchange)) {
        solution.seconds.form_factors = stage.watch.lap();
        return {std::vector<double>(solution.mesh.size(), 0.0), {}};
    }
    solve_matrix(stage, exchange);
    solution.energy = measure_energy(stage.scene, solution.mesh, exchange, solution.radiosity,
                                     solution.irradiance);
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i)
        if (exchange.escaped[i] > 0.0 && (solution.radiosity[i] > 0.0).any())
            solution.form_factors.open = true;
    solution.seconds.solve = stage.watch.lap();
    return {std::move(exchange.backs), {}};
}

}  // namespace patchlight
