#pragma once

#include "solver/accuracy/gathered_light.h"

#include <array>
#include <limits>

namespace patchlight {

/// What the first round aims at, before anything is measured: the least work that `first_target`
/// takes. Lamps are sampled for `target` from the start, as their samples are not joined.
GatherAim first_aim(double target, double first_target, int rays);
/// The noise of rays that goes with it, over `norm` [1].
double first_noise(double first_target);

/// What a round of gathering missed, over `norm`, as it counts in the estimate [1].
struct RoundErrors {
    double direct = 0.0, indirect = 0.0;  // measured at check points
    double noise = 0.0, bent = 0.0;       // of `indirect`, what rays and interpolation explain
    double direct_noise = 0.0;            // of `direct`, what samples of lamps explain
    double direct_bent = 0.0;             // of `direct`, what interpolation explains
    double correction = 0.0;              // what the round changed
    bool read_coarse = false;             // rays read a solution coarser than what they gathered
    bool has_gaps = false;                // that samples of lamps may not find
    double amplified = 1.0;               // what all comes to by going to and fro, over itself
    bool coarse_is_fine = false;          // the coarse solution, about as fine as roots are
};

/// What the next round aims at, where the one before missed the target.
class NextAim {
  public:
    explicit NextAim(double target) : target_(target) {}

    /// What may be missed is shared out among direct light, noise and bends so that the least work
    /// reaches it; each that missed more than its share is brought down to it. `rays_for` tells the
    /// number of rays for a noise that much less. They join those there are where the light they
    /// read was nearly right. Where noise and bends do not explain what was missed, that light was
    /// wrong: rounds alone bring it down, as long as this returns true.
    template <typename RaysFor>
    bool after(const RoundErrors& errors, const RaysFor& rays_for, GatherAim& aim) {
        is_settling_ = false;
        const double less = tighten(errors, aim);
        if (less < 1.0) aim.rays = rays_for(less);
        return is_settling_;
    }

  private:
    /// Of the noise, what there may be; 1: as much as there is.
    double tighten(const RoundErrors& errors, GatherAim& aim);

    static constexpr double inf = std::numeric_limits<double>::infinity();
    double target_;
    bool is_settling_ = false, direct_missed_ = false;
    double last_indirect_ = inf;
    std::array<double, 3> missed_before_{inf, inf, inf};  // per cause, when its aim was cut
};

}  // namespace patchlight
