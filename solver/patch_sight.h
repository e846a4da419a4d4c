#pragma once

#include "solver/form_factors/hemicube_faces.h"
#include "solver/settings.h"

#include <array>
#include <vector>

namespace patchlight {

/// What one patch sees of the others: its row of the form-factor matrix, and a hemicube on it.
struct PatchSight {
    PatchIndex patch = 0;
    std::vector<double> factors;  // F_ij for each patch j, as the engine in use has them [1]
    double backs = 0.0;           // share of its light that lands on backs [1]
    double escaped = 0.0;         // and that leaves the scene [1]
    std::array<HemicubeFace, 5> faces;
    std::vector<double> hemicube_factors;  // the row as the single hemicube has it [1]
};

/// The row of patch i with `planned` settings (those of a solution), closed as shooting closes it,
/// and a hemicube of `resolution` cells along its top face, whichever engine is in use. `mesh` is
/// that of a solution of the scene with these settings.
PatchSight look_from_patch(const Scene& scene, const PatchMesh& mesh, const SolveSettings& planned,
                           PatchIndex i, int resolution);

/// The patch that gives off the most light by itself, the first of several.
PatchIndex brightest_emitter(const Scene& scene, const PatchMesh& mesh);

}  // namespace patchlight
