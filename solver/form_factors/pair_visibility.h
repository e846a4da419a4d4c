#pragma once

#include "solver/form_factors/hemisphere_rays.h"
#include "solver/rays/ray_scene.h"

#include <cstdint>
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

/// Segments between uniform points of both patches, weighted with the kernel; points and scrambles
/// come from (seed, unordered pair).
class PairVisibility {
  public:
    PairVisibility(const HemisphereRays& samplers, const RayScene& ray_scene, int most_samples,
                   std::uint64_t seed);

    /// Takes samples [first, first + count) of every query, both multiples of four, in packets
    /// across queries.
    void measure(std::vector<VisibilityQuery>& queries) const;

  private:
    struct Packet;
    void trace(Packet& packet, std::vector<VisibilityQuery>& queries) const;

    const HemisphereRays& samplers_;
    const RayScene& ray_scene_;
    SobolPoints points_;
    std::uint64_t seed_;
};

}  // namespace patchlight
