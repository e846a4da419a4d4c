#pragma once

#include "solver/display/field_table.h"
#include "solver/mesh/patch_mesh.h"

#include <vector>

namespace patchlight {

/// Adds the radiosity of patches to a table, linear over each: the slope is that of the display
/// mesh made of it, the mean is kept.
void add_sloped(const Scene& scene, const PatchMesh& mesh, const std::vector<Rgb>& radiosity,
                const std::vector<double>& hidden, FieldTable& table);

}  // namespace patchlight
