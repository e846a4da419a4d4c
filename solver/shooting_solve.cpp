#include "solver/accuracy/energy.h"
#include "solver/form_factors/outside_rays.h"
#include "solver/make_engine.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/solve_plan.h"
#include "solver/solve_stage.h"
#include "solver/transport/ambient.h"
#include "solver/transport/patch_fields.h"
#include "solver/transport/shooting.h"

namespace patchlight {

namespace {

/// Where each patch's light goes that meets no front: for the ambient term and the display.
struct Surroundings {
    std::vector<double> front_share, hidden;

    explicit Surroundings(const SolveStage& stage) {
        const OutsideRays probe(stage.scene, stage.solution.mesh, stage.rays, probe_rays,
                                mix(stage.solution.settings.seed, 0x70726f62));
        for (const Outside& outside : probe.everywhere()) {
            front_share.push_back(1.0 - outside.backs - outside.escaped);
            hidden.push_back(outside.backs);
        }
    }
};

/// The solution's fields as they are after some shots.
void take_over(const SolveStage& stage, const ShotSoFar& state) {
    Solution& solution = stage.solution;
    solution.radiosity = to_rgb(state.radiosity);
    solution.irradiance = to_rgb(state.irradiance);
    solution.error.algebraic_bound = state.algebraic_bound;
    Rgb backs = Rgb::Zero(), escaped = Rgb::Zero();
    for (Eigen::Index c = 0; c < 3; ++c) {
        const auto& lost = state.lost[state.lost.size() == 1 ? 0 : static_cast<std::size_t>(c)];
        backs[c] = lost[0];
        escaped[c] = lost[1];
    }
    solution.energy =
        measure_energy(stage.scene, solution.mesh, backs, escaped, solution.irradiance);
    solution.form_factors.open = (escaped > 0.0).any();
}

}  // namespace

DisplayHints solve_by_shooting(const SolveStage& stage) {
    Solution& solution = stage.solution;
    const auto engine = make_engine(stage.scene, solution.mesh, stage.rays, solution.settings,
                                    [&] { return stage.watch.may_prepare(); });
    engine->give_up_unless([&] { return stage.watch.in_time(); });
    RowSource rows(*engine, solution.mesh.size(), kept_row_bytes);
    PatchFields fields = make_patch_fields(stage.scene, solution.mesh);
    const ShootingProblem problem{rows, std::move(fields.area), std::move(fields.exitance),
                                  std::move(fields.reflectance)};
    const Surroundings surroundings(stage);
    const auto hints = [&](const ShotSoFar& state) {
        DisplayHints result{surroundings.hidden, {}};
        if (*solution.settings.ambient && solution.status != Status::converged)
            result.ambient = to_rgb(ambient_irradiance(
                {problem.area, problem.reflectance, surroundings.front_share}, state.unshot));
        return result;
    };
    solution.seconds.form_factors = stage.watch.lap();
    solution.status = Status::limit;  // until the light that is left is too little to show
    ShootingStop stop{*solution.settings.tolerance, *solution.settings.max_iterations, {}};
    stop.observe = [&](const ShotSoFar& state) {
        const std::function<DisplayMesh()> picture = [&] {
            take_over(stage, state);
            return display_of(stage, hints(state));
        };
        const std::function<DisplayMesh()> plain = [&] {
            take_over(stage, state);
            return display_of(stage, {surroundings.hidden, {}});
        };
        Progress progress{Stage::solve, 0.0, state.shots, state.residual};
        progress.unshot = state.unshot_share;
        progress.picture = &picture;
        if (*solution.settings.ambient) progress.picture_without_ambient = &plain;
        return stage.watch.step(progress);
    };
    ShootingReport report = shoot(problem, stop);
    take_over(stage, report.state);
    solution.convergence = std::move(report.convergence);
    solution.within_tolerance = report.stopped_by == StopReason::tolerance;
    solution.status = status_of(report.stopped_by);
    solution.form_factors.rays = rows.rays();
    solution.form_factors.measured = rows.closure();
    solution.form_factors.repaired = rows.closed();
    solution.seconds.solve = stage.watch.lap();
    if (solution.settings.engine == Engine::hemicube && solution.status == Status::converged)
        measure_hemicube_errors(stage);
    solution.seconds.form_factors += stage.watch.lap();
    return hints(report.state);
}

}  // namespace patchlight
