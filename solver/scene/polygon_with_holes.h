#pragma once

#include "solver/scene/scene.h"

#include <span>
#include <string>
#include <vector>

namespace patchlight {

/// As add_polygon, with holes, whichever way their corners run: convex pieces of one face. Throws
/// InputError(pointer) if a hole leaves its plane or its outline, or touches that or another hole.
void add_polygon_with_holes(Scene& scene, ObjectIndex object, MaterialIndex material,
                            std::uint32_t face, std::span<const Vec3> corners,
                            std::span<const std::vector<Vec3>> holes, const std::string& pointer);

}  // namespace patchlight
