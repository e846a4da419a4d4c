#include "solver/solve_scene.h"

#include "solver/accuracy/energy.h"
#include "solver/display/sensor_gather.h"
#include "solver/display/vertex_radiosity.h"
#include "solver/flaws.h"
#include "solver/mesh/make_patches.h"
#include "solver/scene/input_error.h"
#include "solver/solve_plan.h"
#include "solver/solve_stage.h"
#include "solver/transport/patch_fields.h"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace patchlight {

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

DisplayMesh display_of(const SolveStage& stage, const DisplayHints& hints) {
    const Solution& solution = stage.solution;
    if (hints.ambient.empty())
        return make_display(stage.scene, solution.mesh, solution.radiosity, hints.hidden);
    std::vector<Rgb> shown = solution.radiosity;
    for (PatchIndex i = 0; i < solution.mesh.size(); ++i) {
        const Surface& surface = stage.scene.surfaces[solution.mesh.patches[i].surface];
        shown[i] += stage.scene.materials[surface.material].reflectance * hints.ambient[i];
    }
    return make_display(stage.scene, solution.mesh, shown, hints.hidden);
}

namespace {

/// Of a time limit: by then what the scene is searched for that only its author needs to know.
constexpr double for_findings = 0.35;

/// Light that no surface absorbs never dies out, and there is no solution.
void refuse_impossible(const std::vector<Material>& materials) {
    for (const Material& material : materials) {
        if (!((material.reflectance >= 0.0) && (material.reflectance < 1.0)).all())
            throw InputError("/materials",
                             "reflectance must be from 0 to below 1, or light never "
                             "dies out (near-singular)");
        if (!((material.exitance >= 0.0) && material.exitance.isFinite()).all())
            throw InputError("/materials", "exitance must be a finite number, at least 0");
    }
}

/// As often as `go_on` is asked, patches are counted: creases make more than were foretold.
void cut_patches(const Scene& scene, const MeshLines& lines, const std::function<bool()>& go_on,
                 Solution& solution) {
    const SolveSettings& settings = solution.settings;
    check_memory(scene, estimate_patch_count(scene, *settings.patch_size, lines.cut_slivers),
                 settings);
    solution.mesh =
        make_patches(scene, lines, *settings.patch_size, [&](std::size_t patches_so_far) {
            check_memory(scene, patches_so_far, settings);
            return go_on();
        });
    check_memory(scene, solution.mesh.size(), settings);
    solution.radiosity = exitances(scene, solution.mesh);
    solution.irradiance.assign(solution.mesh.size(), Rgb::Zero());
}

/// What there is where the work ended before there were patches: polygons as they are given.
void show_lamps_alone(const Scene& scene, Solution& solution) {
    solution.mesh = uncut_patches(scene);
    solution.radiosity = exitances(scene, solution.mesh);
    solution.irradiance.assign(solution.mesh.size(), Rgb::Zero());
    solution.display = make_display(scene, solution.mesh, solution.radiosity,
                                    std::vector<double>(solution.mesh.size(), 0.0));
    solution.objects = measure_objects(scene, solution);
}

/// Some time for it there is even if the work was to end before: few sensors take less.
void gather(const SolveStage& stage) {
    constexpr double least_seconds = 1.0;
    Solution& solution = stage.solution;
    StopReason stopped = StopReason::tolerance;
    const auto go_on = [&](double fraction) {
        stopped = stage.watch.step({Stage::display, fraction});
        return stopped == StopReason::tolerance || stage.watch.seconds_so_far() < least_seconds;
    };
    solution.sensors = gather_at_sensors(stage.scene, solution.mesh, stage.rays, solution.radiosity,
                                         solution.settings.seed, go_on);
    if (solution.sensors.size() < stage.scene.sensors.size()) solution.status = status_of(stopped);
}

/// What the field's error makes of the light that surfaces send to the sensors.
void count_field_error(Solution& solution) {
    for (SensorReport& sensor : solution.sensors)
        sensor.error =
            std::hypot(sensor.error, solution.error.estimate.value_or(0.0) * sensor.reflected);
}

/// Where the work ended before anything was measured, all the light is taken for missing.
void count_all_as_missing(const Scene& scene, Solution& solution) {
    if (!solution.settings.accuracy || solution.error.estimate) return;
    solution.error.target = solution.settings.accuracy;
    if (solution.status == Status::converged) return;
    const bool is_lit = std::any_of(
        scene.surfaces.begin(), scene.surfaces.end(),
        [&](const Surface& s) { return !scene.materials[s.material].exitance.isZero(0.0); });
    if (is_lit) solution.error.estimate = 1.0;
}

}  // namespace

Solution solve_scene(const Scene& scene, const SolveSettings& settings, const Observer& observe,
                     std::span<const Viewpoint> viewpoints) {
    if (scene.surfaces.empty())
        throw InputError("/objects", "nothing with an area is left to solve");
    refuse_impossible(scene.materials);
    SolvePlan plan = plan_solve(scene, settings);
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(plan.settings.threads));
    Watch watch(observe, settings.time_limit);
    Solution solution;
    solution.settings = plan.settings;
    solution.why = std::move(plan.why);
    StopReason stopped = StopReason::tolerance;
    const auto go_on = [&] {
        stopped = stopped == StopReason::tolerance ? watch.step({Stage::mesh}) : stopped;
        return stopped == StopReason::tolerance;
    };
    MeshLines lines = find_mesh_lines(scene, go_on);
    if (solution.settings.accuracy && stopped == StopReason::tolerance) add_gap_lines(scene, lines);
    lines.cut_slivers = solution.settings.method != Method::hierarchical;
    if (stopped == StopReason::tolerance) cut_patches(scene, lines, go_on, solution);
    if (stopped != StopReason::tolerance) {
        show_lamps_alone(scene, solution);
        solution.status = status_of(stopped);
        count_all_as_missing(scene, solution);
        solution.seconds.mesh = watch.lap();
        return solution;
    }
    const RayScene rays(scene, lines.overlaps);
    Flaws flaws = find_flaws(scene, lines.overlaps, rays, solution.settings, viewpoints, [&] {
        return watch.step({Stage::mesh}, for_findings) == StopReason::tolerance;
    });
    solution.findings = std::move(flaws.findings);
    solution.misplaced = std::move(flaws.misplaced);
    solution.seconds.mesh = watch.lap();
    const SolveStage stage{scene, rays, watch, solution};
    if (solution.settings.accuracy) {
        solve_to_accuracy(stage, lines);
        count_all_as_missing(scene, solution);
        count_field_error(solution);
        solution.objects = measure_objects(scene, solution);
        return solution;
    }
    const DisplayHints hints = solution.settings.method == Method::shooting
                                   ? solve_by_shooting(stage)
                                   : solve_on_matrix(stage);
    solution.display = display_of(stage, hints);
    gather(stage);
    const double shown = watch.seconds_so_far();
    if (solution.settings.measure_error && solution.status != Status::cancelled)
        check_solution(stage, lines);
    count_field_error(solution);
    solution.seconds.measuring += watch.seconds_so_far() - shown;
    solution.objects = measure_objects(scene, solution);
    solution.seconds.display = watch.lap();
    return solution;
}

}  // namespace patchlight
