#pragma once

#include "solver/form_factors/hemicube_engine.h"
#include "tests/solver/form_factors/engine_scene.h"

#include <optional>
#include <string>

namespace patchlight {

/// The unit square centred on the origin, looking up, and a second polygon, each one patch.
class HemicubePair {
  public:
    HemicubePair(std::string name, const Polygon& target);

    const std::string& name() const { return name_; }
    const EngineScene& scene() const { return scene_; }
    HemicubeEngine engine(int resolution, int sub_samples, std::uint64_t seed = 1,
                          bool rotated = true) const;
    /// The factor and its variance as the engine tells them; 0 if the target was missed.
    struct Entry {
        double factor = 0.0, variance = 0.0;
    };
    static Entry entry(const HemicubeEngine& engine);

    /// Mean of the exact factors of the centres of k × k parts.
    double at_centres(int k) const;

  private:
    std::string name_;
    Polygon target_;
    EngineScene scene_;
};

HemicubePair parallel_pair(double distance);
/// A unit square that stands on the edge of the first.
HemicubePair perpendicular_pair();
/// A square of edge 0.1 about (0.3, 0, 5), facing down.
HemicubePair small_pair();

}  // namespace patchlight
