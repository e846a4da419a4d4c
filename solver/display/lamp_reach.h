#pragma once

#include "solver/display/light_sources.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// What light straight from sources reaches, told by a few rays from each.
struct LampReach {
    /// Area of the surfaces that send light back and that rays meet, of each no more than a disc
    /// three times as wide as it is far: most of a wide ground gets no light worth speaking of.
    /// Where no ray meets any, all that send light back [m²].
    double area = 0.0;
    std::vector<double> landed;  // per source: share of its rays that meets such a surface [1]
};

LampReach find_lamp_reach(const Scene& scene, const RayScene& rays,
                          const std::vector<LightSource>& sources, std::uint64_t seed);

}  // namespace patchlight
