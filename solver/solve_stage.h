#pragma once

#include "solver/form_factors/exchange_matrix.h"
#include "solver/mesh/make_patches.h"
#include "solver/rays/ray_scene.h"
#include "solver/solution.h"
#include "solver/watch.h"

#include <vector>

namespace patchlight {

/// A solve between mesh and display: what the ways to solve have in common.
struct SolveStage {
    const Scene& scene;
    const RayScene& rays;
    Watch& watch;
    Solution& solution;
};

/// What the display needs beside the solution.
struct DisplayHints {
    std::vector<double> hidden;  // share of each patch that sees nothing but backs [1]
    std::vector<Rgb> ambient;    // irradiance of light not yet sent on; empty: none [W/m²]
};

/// Form factors of all pairs, closure repaired; false if the work was stopped.
bool find_form_factors(const SolveStage& stage, ExchangeMatrix& exchange);

/// Fills in what the hemicubes' errors are made of, if the settings want errors measured, and
/// counts the time it takes as measuring.
void measure_hemicube_errors(const SolveStage& stage);

/// Form factors of all pairs, closure repaired, then Gauss–Seidel. Fills the solution's radiosity,
/// irradiance, form-factor report, energy, error and status.
DisplayHints solve_on_matrix(const SolveStage& stage);

/// Progressive shooting with rows on demand; fills the same.
DisplayHints solve_by_shooting(const SolveStage& stage);

/// Solves to `settings.accuracy`: the coarse solution, the display gathered from it and refined
/// until what is measured at check points is within the target. Fills the same, the display and
/// the sensors.
void solve_to_accuracy(const SolveStage& stage, const MeshLines& lines);

/// Estimates the error of a display that was made by hand-set means, as that of a solve to an
/// accuracy is estimated.
void check_solution(const SolveStage& stage, const MeshLines& lines);

/// The field that pictures show, from the solution's patches and the hints.
DisplayMesh display_of(const SolveStage& stage, const DisplayHints& hints);

}  // namespace patchlight
