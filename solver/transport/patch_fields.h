#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/transport/radiosity_problem.h"

#include <vector>

namespace patchlight {

/// What patches are made of: one channel if the scene is grey, else three.
struct PatchFields {
    std::vector<double> area;  // [m²]
    Field exitance;            // [W/m²]
    Field reflectance;         // [1]
};
PatchFields make_patch_fields(const Scene& scene, const PatchMesh& mesh);

/// One channel stands for all three.
std::vector<Rgb> to_rgb(const Field& field);

std::vector<Rgb> exitances(const Scene& scene, const PatchMesh& mesh);

}  // namespace patchlight
