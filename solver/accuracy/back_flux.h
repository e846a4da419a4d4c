#pragma once

#include "solver/accuracy/shown_places.h"

#include <cstdint>
#include <vector>

namespace patchlight {

/// Light of a displayed field that lands on backs [W].
struct BackFlux {
    Rgb flux = Rgb::Zero();
    Rgb variance = Rgb::Zero();  // of it [W²]
};

/// Gathers light at backs that are open to it: rays from points on them tell how bright it is where
/// they land. A small back in a bright room takes far fewer of them than rays from all that is
/// bright, of which few meet it.
class BackGather {
  public:
    /// Which backs are open a few rays from each tell, about `count` in all; none are where there
    /// are too many surfaces for that. Those that a few rays miss are left out: most of them face
    /// away from all light. So are those of surfaces in whose plane others lie, that may hide them.
    BackGather(const Scene& scene, const PatchMesh& mesh, const CoplanarOverlaps& overlaps,
               const RayScene& rays, std::size_t count, std::uint64_t seed);

    /// Per surface: whether its back is gathered at.
    const std::vector<bool>& gathered() const { return gathered_; }
    /// With as many rays as leave a standard error of `noise` [W], `count` at most.
    BackFlux flux(const TreeDisplay& shown, const ShownPlaces& places, double noise,
                  std::size_t count) const;

  private:
    struct Tally;
    struct Back {
        SurfaceIndex surface = 0;
        std::vector<double> areas;  // of its triangles, cumulated [m²]
        std::vector<std::array<VertexIndex, 3>> triangles;
        double area() const { return areas.empty() ? 0.0 : areas.back(); }
    };
    Back back_of(SurfaceIndex s) const;
    Tally look(const Back& back, std::size_t first, const TreeDisplay* shown,
               const ShownPlaces* places) const;

    const Scene& scene_;
    const PatchMesh& mesh_;
    const RayScene& rays_;
    std::uint64_t seed_;
    std::vector<bool> gathered_;
    std::vector<Back> backs_;  // those that are gathered at
};

}  // namespace patchlight
