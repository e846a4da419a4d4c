#pragma once

#include "solver/rays/ray_scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace patchlight {

/// Embree and nothing else, on the triangles that RayScene builds: the floor for the cost of a ray.
class BareEmbree {
  public:
    BareEmbree(const Scene& scene, const RayScene& ray_space);
    ~BareEmbree();

    /// Sum of the triangles hit, so that nothing is optimised away.
    std::uint64_t one_by_one(const std::vector<RayBatch>& rays) const;
    std::uint64_t in_packets(const std::vector<RayBatch>& rays) const;

  private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

}  // namespace patchlight
