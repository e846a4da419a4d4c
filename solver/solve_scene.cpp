#include "solver/solve_scene.h"

#include "solver/accuracy/energy.h"
#include "solver/display/sensor_gather.h"
#include "solver/display/vertex_radiosity.h"
#include "solver/form_factors/analytic_engine.h"
#include "solver/form_factors/ray_cast_engine.h"
#include "solver/form_factors/repair_closure.h"
#include "solver/mesh/make_patches.h"
#include "solver/scene/input_error.h"
#include "solver/solve_plan.h"
#include "solver/transport/gauss_seidel.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <stdexcept>

namespace patchlight {

namespace {

using Clock = std::chrono::steady_clock;

/// Passes progress on, and remembers why the work was stopped.
class Watch {
  public:
    Watch(const Observer& observe, std::optional<double> time_limit)
        : observe_(observe), time_limit_(time_limit) {}

    /// Seconds since the last lap.
    double lap() {
        const auto now = Clock::now();
        const double seconds = std::chrono::duration<double>(now - lap_).count();
        lap_ = now;
        return seconds;
    }
    StopReason step(const Progress& progress) {
        if (observe_ && observe_(progress) == Verdict::stop) return StopReason::cancelled;
        const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        if (time_limit_ && seconds > *time_limit_) return StopReason::time_limit;
        return StopReason::tolerance;
    }

  private:
    const Observer& observe_;
    std::optional<double> time_limit_;
    Clock::time_point start_ = Clock::now(), lap_ = start_;
};

std::unique_ptr<FormFactorEngine> make_engine(const Scene& scene, const PatchMesh& mesh,
                                              const RayScene& rays, const SolveSettings& settings) {
    switch (settings.engine) {
        case Engine::analytic: {
            AnalyticSettings analytic;
            analytic.rays = *settings.rays;
            analytic.seed = settings.seed;
            return std::make_unique<AnalyticEngine>(scene, mesh, rays, analytic);
        }
        case Engine::ray_cast:
            return std::make_unique<RayCastEngine>(scene, mesh, rays, *settings.rays,
                                                   settings.seed);
        case Engine::automatic:
        case Engine::hemicube:
            break;
    }
    throw std::logic_error("engine without a case");
}

RadiosityProblem make_problem(const Scene& scene, const PatchMesh& mesh,
                              const FormFactorMatrix& factors) {
    RadiosityProblem problem{factors, {}, {}, {}};
    const std::size_t channels = is_grey(scene) ? 1 : 3;
    problem.exitance.assign(channels, std::vector<double>(mesh.size()));
    problem.reflectance = problem.exitance;
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        problem.area.push_back(mesh.patches[i].area);
        const Material& material =
            scene.materials[scene.surfaces[mesh.patches[i].surface].material];
        for (std::size_t c = 0; c < channels; ++c) {
            problem.exitance[c][i] = material.exitance[static_cast<Eigen::Index>(c)];
            problem.reflectance[c][i] = material.reflectance[static_cast<Eigen::Index>(c)];
        }
    }
    return problem;
}

std::vector<Rgb> to_rgb(const Field& field) {
    std::vector<Rgb> rgb(field[0].size());
    for (std::size_t i = 0; i < rgb.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            rgb[i][static_cast<Eigen::Index>(c)] = field[field.size() == 1 ? 0 : c][i];
    return rgb;
}

std::vector<Rgb> exitances(const Scene& scene, const PatchMesh& mesh) {
    std::vector<Rgb> exitance;
    for (const Patch& patch : mesh.patches)
        exitance.push_back(scene.materials[scene.surfaces[patch.surface].material].exitance);
    return exitance;
}

std::vector<Finding> flaws(const Scene& scene, const CoplanarOverlaps& overlaps) {
    std::vector<Finding> findings = scene.findings;
    for (Finding& finding : overlap_findings(scene, overlaps))
        findings.push_back(std::move(finding));
    const bool lit = std::any_of(
        scene.surfaces.begin(), scene.surfaces.end(),
        [&](const Surface& s) { return (scene.materials[s.material].exitance > 0.0).any(); });
    if (!lit)
        findings.push_back({"no-emitter",
                            {},
                            "nothing in the scene gives off light, so all of it is black",
                            "give a material `exitance` or `radiance`",
                            1});
    return findings;
}

Status status_of(StopReason reason) {
    switch (reason) {
        case StopReason::tolerance:
            return Status::converged;
        case StopReason::iteration_limit:
        case StopReason::time_limit:
            return Status::limit;
        case StopReason::cancelled:
            return Status::cancelled;
    }
    throw std::logic_error("stop reason without a case");
}

struct Solver {
    const Scene& scene;
    Watch watch;
    Solution solution;
    ExchangeMatrix exchange;

    void cut_patches(const MeshLines& lines) {
        const SolveSettings& settings = solution.settings;
        check_memory(scene, estimate_patch_count(scene, *settings.patch_size), settings);
        solution.mesh = make_patches(scene, lines, *settings.patch_size);
        check_memory(scene, solution.mesh.size(), settings);
        solution.radiosity = exitances(scene, solution.mesh);
        solution.irradiance.assign(solution.mesh.size(), Rgb::Zero());
        solution.seconds.mesh = watch.lap();
    }

    bool find_form_factors(const RayScene& rays) {
        const auto engine = make_engine(scene, solution.mesh, rays, solution.settings);
        StopReason stopped = StopReason::tolerance;
        exchange = build_exchange(*engine, scene, solution.mesh, [&](double fraction) {
            stopped = watch.step({Stage::form_factors, fraction, 0, 0.0});
            return stopped == StopReason::tolerance;
        });
        solution.form_factors.rays = exchange.rays;
        if (!exchange.complete) {
            solution.status = status_of(stopped);
            solution.seconds.form_factors = watch.lap();
            return false;
        }
        solution.form_factors.measured = exchange.measured;
        repair_closure(exchange);
        solution.form_factors.repaired = measure_closure(exchange);
        return true;
    }

    void solve() {
        const FormFactorMatrix factors(exchange);
        std::vector<float>().swap(exchange.exchange);
        std::vector<float>().swap(exchange.variance);
        std::vector<float>().swap(exchange.ceiling);
        std::vector<PatchIndex>().swap(exchange.column);
        solution.seconds.form_factors = watch.lap();
        const RadiosityProblem problem = make_problem(scene, solution.mesh, factors);
        StopRule stop{*solution.settings.tolerance, *solution.settings.max_iterations, {}};
        stop.observe = [&](int iteration, double residual) {
            return watch.step({Stage::solve, 0.0, iteration, residual});
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
        solution.energy =
            measure_energy(scene, solution.mesh, exchange, solution.radiosity, solution.irradiance);
        for (PatchIndex i = 0; i < solution.mesh.size(); ++i)
            if (exchange.escaped[i] > 0.0 && (solution.radiosity[i] > 0.0).any())
                solution.form_factors.open = true;
        solution.seconds.solve = watch.lap();
    }

    void show(const RayScene& rays) {
        const std::vector<double> hidden =
            exchange.complete ? exchange.backs : std::vector<double>(solution.mesh.size(), 0.0);
        solution.display = make_display(scene, solution.mesh, solution.radiosity, hidden);
        solution.sensors = gather_at_sensors(scene, solution.mesh, rays, solution.radiosity,
                                             solution.settings.seed);
        solution.objects = measure_objects(scene, solution);
        solution.seconds.display = watch.lap();
    }
};

}  // namespace

std::vector<Finding> find_flaws(const Scene& scene) {
    return flaws(scene, find_coplanar_overlaps(scene));
}

Solution solve_scene(const Scene& scene, const SolveSettings& settings, const Observer& observe) {
    if (scene.surfaces.empty())
        throw InputError("/objects", "nothing with an area is left to solve");
    SolvePlan plan = plan_solve(scene, settings);
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(plan.settings.threads));
    Solver solver{scene, Watch(observe, settings.time_limit), {}, {}};
    solver.solution.settings = plan.settings;
    solver.solution.why = std::move(plan.why);
    const MeshLines lines = find_mesh_lines(scene);
    solver.solution.findings = flaws(scene, lines.overlaps);
    solver.cut_patches(lines);
    const RayScene rays(scene, lines.overlaps);
    if (solver.find_form_factors(rays)) solver.solve();
    solver.show(rays);
    return std::move(solver.solution);
}

}  // namespace patchlight
