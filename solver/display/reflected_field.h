#pragma once

#include "solver/display/field_table.h"
#include "solver/rays/patch_locator.h"
#include "solver/rays/ray_scene.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace patchlight {

/// Radiosity as rays read it, without that of sources that are gathered from one by one. What is
/// much brighter than the mean (a ceiling over an uplight) is seen as made of two parts: what goes
/// beyond a threshold, the excess, can be sampled by itself, as lamps are.
class ReflectedField {
  public:
    ReflectedField(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                   const PatchLocator& locator, FieldTable table);

    struct Seen {
        std::array<float, 3> radiosity;  // [W/m²]
        float excess_share = 0.0f;       // of it, beyond the threshold [1]
        float density = 0.0f;            // of samples of the excess there, per area of ray space
    };
    /// At a point of surface s in ray space.
    Seen at(SurfaceIndex s, float x, float y, float z) const {
        const PatchIndex i = locator_.find(s, x, y, z);
        const std::size_t cell = table_.cell(i, x, y, z);
        return seen(cell);
    }

    /// Whether there is an excess worth sampling.
    bool has_excess() const { return !bright_.empty(); }
    struct Sample {
        RayPoint position;  // above its surface [ray space]
        RayPoint normal;
        FrameIndex frame = 0;  // of `position`
        Seen seen;
        bool on_patch = true;  // false: beside its patch; counts as unseen
    };
    /// A point of the excess with the density `seen` tells, from three numbers in [0, 1).
    Sample sample(float pick, float u, float v) const;

    const RayPoint& normal(SurfaceIndex s) const { return normals_[s]; }

  private:
    Seen seen(std::size_t cell) const {
        Seen seen;
        seen.radiosity = table_.value(cell);
        const float y = luminance_of(seen.radiosity);
        if (y > threshold_) {
            seen.excess_share = 1.0f - threshold_ / y;
            seen.density = (y - threshold_) * per_power_;
        }
        return seen;
    }
    static float luminance_of(const std::array<float, 3>& rgb) {
        return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
    }

    struct Bright {
        std::size_t cell = 0;
        PatchIndex patch = 0;
        double power = 0.0;  // cumulated
    };
    const Bright& bright_at(float pick) const;
    const PatchMesh& mesh_;
    const RayScene& rays_;
    const PatchLocator& locator_;
    FieldTable table_;
    std::vector<RayPoint> normals_;     // of surfaces
    std::vector<Bright> bright_;        // cells with an excess
    std::vector<std::uint32_t> guide_;  // per equal step of power: where in `bright_` it begins
    float threshold_ = std::numeric_limits<float>::infinity();  // [W/m²]
    float per_power_ = 0.0f;  // one over the excess times its area in ray space, summed
};

}  // namespace patchlight
