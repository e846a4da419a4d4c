#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/rays/ray_scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight {

/// One face of a hemicube, row by row from the top, as seen from inside.
struct HemicubeFace {
    static constexpr std::uint32_t nothing = 0xffffffff;  // light leaves the scene there
    static constexpr std::uint32_t back = 0xfffffffe;     // of a one-sided surface

    int width = 0, height = 0;          // [cells]
    std::vector<std::uint32_t> seen;    // the patch seen through each cell, or one of the above
    std::vector<double> delta_factors;  // of each cell; all five faces sum to 1 [1]
};

/// The faces of one hemicube (Cohen & Greenberg, 1985) at the centre of patch i, its x axis along
/// the patch's first edge: the top, then the sides towards +x, -x, +y and -y, each with the normal
/// upwards. Right of the top are the cells towards -x, above those towards +y. What is summed over
/// cells that see patch j is F_ij as a single hemicube has it.
std::array<HemicubeFace, 5> hemicube_faces(const Scene& scene, const PatchMesh& mesh,
                                           const RayScene& rays, PatchIndex i, int resolution);

}  // namespace patchlight
