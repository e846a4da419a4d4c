#pragma once

#include "solver/display/reflected_field.h"
#include "solver/display/vertex_gather.h"

#include <cstdint>

namespace patchlight {

/// How noisy indirect irradiance gathered with so many rays is, measured by gathering twice at
/// points half of which are spread over the scene's area, half over its light.
class GatherNoise {
  public:
    /// `reflected`: about what patches send back [W/m²].
    GatherNoise(const Scene& scene, const PatchMesh& mesh, const VertexGather& gather,
                const ReflectedField& field, const std::vector<Rgb>& reflected, std::uint64_t seed);

    /// √∫ Y(ρ·noise)² dA of single points [W/m].
    double absolute(int rays) const;
    /// The fewest rays, a multiple of 32 between `least` and `most`, that bring `absolute` to it.
    int rays_for(double absolute, int least, int most) const;

  private:
    double absolute_ = 0.0;  // with the rays of the measurement
};

}  // namespace patchlight
