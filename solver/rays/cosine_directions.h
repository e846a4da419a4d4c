#pragma once

#include "solver/rays/ray_scene.h"

#include <array>
#include <cstdint>

namespace patchlight {

using Lanes = std::array<float, ray_batch>;

/// Sobol coordinates of 16 successive points in each of D dimensions, one scramble for each:
/// `reversed[d]` holds their bits in reverse order. In [0, 1).
void scramble_lanes(const std::array<const std::uint32_t*, 4>& reversed,
                    const std::array<std::uint32_t, 4>& seeds, std::array<Lanes, 4>& u);

/// The same in two dimensions.
void scramble_lanes(const std::array<const std::uint32_t*, 2>& reversed,
                    const std::array<std::uint32_t, 2>& seeds, std::array<Lanes, 2>& u);

struct RayFrame {
    RayPoint tangent, bitangent, normal;  // right-handed, unit
};
RayFrame frame_about(const RayPoint& normal);

/// One direction about the normal with density cosine / π, from two numbers in [0, 1).
RayPoint cosine_direction(const RayFrame& frame, float u, float v);

/// Directions about the normal with density cosine / π: radius √u on the disk, angle 2πv, lifted.
void cosine_directions(const RayFrame& frame, const Lanes& u, const Lanes& v, RayBatch& batch);

}  // namespace patchlight
