#pragma once

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

/// Form factors of all pairs, closure repaired, then Gauss–Seidel. Fills the solution's radiosity,
/// irradiance, form-factor report, energy, error and status.
DisplayHints solve_on_matrix(const SolveStage& stage);

/// Progressive shooting with rows on demand; fills the same.
DisplayHints solve_by_shooting(const SolveStage& stage);

/// The field that pictures show, from the solution's patches and the hints.
DisplayMesh display_of(const SolveStage& stage, const DisplayHints& hints);

}  // namespace patchlight
