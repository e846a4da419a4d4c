#pragma once

#include "solver/rays/low_discrepancy.h"
#include "solver/rays/patch_sampler.h"
#include "solver/rays/ray_scene.h"

#include <array>
#include <cstdint>

namespace patchlight {

constexpr int four = 4;  // samples of one pair that are made side by side

/// Both ends of a pair of patches, lifted off their surfaces, and the pair's scrambles.
struct PairEnds {
    const PatchSampler& from;
    const PatchSampler& to;
    RayPoint above_from, above_to;  // added to points of each [ray space]
    RayPoint shift;  // added to points of the second to have them in the frame of the first
    std::array<std::uint32_t, 4> seeds;
};

/// Samples `first` up to `first + 4` of a pair: segments into lanes [lane, lane + 4) of the batch,
/// their kernel cos cos / r⁴ into `weights`, 0 for one that leaves or arrives from behind.
void make_four_samples(const PairEnds& ends, const SobolPoints& points, int first, int lane,
                       RayBatch& batch, std::array<float, ray_batch>& weights);

}  // namespace patchlight
