#pragma once

#include "solver/display/light_sources.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// Area of the surfaces that send light back and that rays from sources meet, of each no more than
/// a disc three times as wide as it is far: most of a wide ground gets no light worth speaking of.
/// Where no ray meets any, all that send light back [m²].
double lit_area(const Scene& scene, const RayScene& rays, const std::vector<LightSource>& sources,
                std::uint64_t seed);

}  // namespace patchlight
