#pragma once

#include "solver/form_factors/hemisphere_rays.h"
#include "solver/rays/ray_scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace patchlight {

/// A pair of patches whose mutual visibility rays shall measure.
struct VisibilityQuery {
    PatchIndex i = 0, j = 0;
    double share = 0.0;        // of the light in question that it carries [1]
    int first = 0, count = 0;  // sample numbers to take now
    float clear_weight = 0.0f, weight = 0.0f, weight_squared = 0.0f;  // sums over samples so far
    int clear = 0, taken = 0;

    /// Share of the kernel that is clear [1].
    double visibility() const {
        return weight > 0.0f ? static_cast<double>(clear_weight) / static_cast<double>(weight)
                             : 0.0;
    }
    /// Variance of that share, never 0: "all of n agree" is known to 1/n (Laplace's rule).
    double variance() const;
};

/// Segments between uniform points of both patches, weighted with the kernel. Scrambles come from
/// (seed, patch i), and sample numbers go on from one query of a row to the next: all of a row's
/// samples are one low-discrepancy sequence over patch i, so that errors even out over its pairs
/// (on the Cornell box, 9641 patches: half the error of a sequence for each pair).
class PairVisibility {
  public:
    /// After `points` samples, a multiple of four, they are scrambled anew.
    PairVisibility(const HemisphereRays& samplers, const RayScene& ray_scene, int points,
                   std::uint64_t seed);

    /// Takes samples [first, first + count) of every query, both multiples of four, in packets
    /// across queries. `look_at_clock` is called now and then, and may throw.
    void measure(std::vector<VisibilityQuery>& queries,
                 const std::function<void()>& look_at_clock = {}) const;

  private:
    struct Packet;
    std::array<std::uint32_t, 4> scrambles(PatchIndex i, int turn) const;
    void trace(Packet& packet, std::vector<VisibilityQuery>& queries) const;

    const HemisphereRays& samplers_;
    const RayScene& ray_scene_;
    SobolPoints points_;
    std::uint64_t seed_;
};

}  // namespace patchlight
