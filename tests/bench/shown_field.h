#pragma once

#include "solver/rays/ray_scene.h"
#include "solver/solution.h"

#include <vector>

namespace patchlight {

/// Luminance that surfaces reflect, B - E [W/m²], of a displayed solution.
class ShownField {
  public:
    ShownField(const Scene& scene, const Solution& solution);
    double at(SurfaceIndex surface, const Vec3& p) const;

  private:
    friend class ShownLattices;
    struct Corner {
        Vec3 position;
        double reflected;
    };
    std::vector<std::vector<std::array<Corner, 3>>> of_surface_;  // triangles
    std::vector<Vec3> normal_;
};

/// The same on a lattice over each surface, quick enough for rays. Surfaces are parallelograms.
class ShownLattices {
  public:
    ShownLattices(const Scene& scene, const ShownField& shown, const RayScene& rays);
    double at(SurfaceIndex surface, const RayPoint& p) const;

  private:
    struct Sheet {
        RayPoint origin, u, v;
        std::vector<double> values;
    };
    std::vector<Sheet> sheets_;
};

}  // namespace patchlight
