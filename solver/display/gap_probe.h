#pragma once

#include "solver/display/aperture.h"

#include <optional>

namespace patchlight {

/// Feels by parallel lines how far a gap reaches. All in ray space.
struct GapProbe {
    static constexpr float grazing = 0.2f;  // cosine: a plane that light hardly crosses

    const RayScene& rays;
    RayPoint direction;  // unit, of light that goes through
    float reach = 0.0f;  // of a line before and behind the gap, at most: farther off nothing counts
    float widest = 0.0f;  // gap that is looked for

    /// The gap about a point that is clear: as wide as lines are clear in the plane of `outward`
    /// and `along` if light does not graze it, else across the light. None if it is wider than
    /// `widest` both ways, or hardly a gap.
    std::optional<Aperture> find(const RayPoint& point, const RayPoint& outward,
                                 const RayPoint& along, const RayPoint& normal) const;

  private:
    struct Axes {
        RayPoint first, second;
    };
    std::optional<Axes> axes(const RayPoint& outward, const RayPoint& along,
                             const RayPoint& normal) const;
    /// Whether something bounds it on both sides of an axis: sixteen lines, to tell quickly.
    bool may_be_gap(const RayPoint& point, const Axes& axes) const;
    float half_at(float offset) const;
    bool is_blocked(const RayPoint& point, float half) const;
    /// Nothing blocks within `half` before and behind, and light that goes on meets a front.
    bool is_clear(const RayPoint& point, float half) const;
    struct Reach {
        float clear = 0.0f;
        bool ends = false;  // at a surface
    };
    Reach clear_along(const RayPoint& point, const RayPoint& unit, float first, float most,
                      float width) const;
};

}  // namespace patchlight
