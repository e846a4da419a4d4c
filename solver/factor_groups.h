#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace patchlight {

/// Between what view factors are told: objects, polygons and mesh faces as they were given, or
/// patches.
enum class Grouping : std::uint8_t { object, face, patch };

/// Which patches are told of as one. An object without geometry of its own has none, and area 0.
struct FactorGroups {
    std::vector<std::string> names;  // paths, faces of several as path[k]; empty: known by index
    std::vector<double> areas;       // both sides of two-sided ones [m²]
    std::vector<std::vector<PatchIndex>> patches;  // of each group, ascending
    std::vector<std::uint32_t> of_patch;
};

/// Groups are numbered as objects, as faces come in the scene, or as patches.
FactorGroups make_factor_groups(const Scene& scene, const PatchMesh& mesh, Grouping grouping);

}  // namespace patchlight
