#pragma once

#include "solver/solution.h"

#include <array>
#include <cstdint>
#include <vector>

namespace patchlight::server {

/// The part of a display mesh that is one object's.
struct ObjectMesh {
    ObjectIndex object = 0;
    std::vector<std::uint32_t> vertices;                  // of the display mesh, ascending
    std::vector<std::array<std::uint32_t, 3>> triangles;  // of places in `vertices`
};

/// A display mesh taken apart, in the order of objects; those of which nothing is shown are left
/// out, and so are vertices without a triangle.
std::vector<ObjectMesh> object_meshes(const Scene& scene, const Solution& solution);

}  // namespace patchlight::server
