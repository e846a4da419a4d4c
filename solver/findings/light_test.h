#pragma once

#include "solver/findings/walkers.h"

#include <vector>

namespace patchlight {

/// Tells whether lamps are seen from a place.
class LightTest {
  public:
    explicit LightTest(const FlawSearch& search);

    bool any() const { return !emitters_.empty(); }
    /// Whether a point of a lamp drawn by power is seen from p, in ray space, by what faces
    /// `normal`.
    bool sees_lamp(const RayPoint& p, FrameIndex frame, const RayPoint& normal,
                   std::uint64_t seed) const;
    bool gives_light(SurfaceIndex s) const { return power_[s] > 0.0; }
    const std::vector<double>& power() const { return power_; }  // per surface, luminance [W]

  private:
    const FlawSearch& search_;

    std::vector<double> power_;
    std::vector<SurfaceIndex> emitters_;
    std::vector<SurfacePoints> points_;  // of each emitter
    std::vector<double> up_to_;          // sum of powers up to each emitter [W]
};

}  // namespace patchlight
