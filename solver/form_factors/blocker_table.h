#pragma once

#include "solver/mesh/patch_mesh.h"
#include "solver/scene/plane_groups.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace patchlight {

/// Tells which pairs of patches nothing can stand between, without a ray. Patches are grouped into
/// small clusters of one plane; for two clusters the surfaces of a plane may block unless both lie
/// on one side of it, or they lie behind either's, or a plane parts them from the clusters' convex
/// hull. Conservative: "may block" can be wrong, "cannot" never is.
class BlockerTable {
  public:
    /// `go_on` is asked now and then from the calling thread; false ends the work, and every pair
    /// may be blocked.
    BlockerTable(const Scene& scene, const PatchMesh& mesh, const PlaneGroups& groups,
                 const std::function<bool()>& go_on = {});

    bool may_block(PatchIndex i, PatchIndex j) const {
        if (always_) return true;
        return (bits_[cluster_[i] * words_ + cluster_[j] / 64] >> (cluster_[j] % 64)) & 1u;
    }

  private:
    bool always_ = false;                 // there is no table: rays must tell
    std::vector<std::uint32_t> cluster_;  // of each patch
    std::size_t words_ = 0;
    std::vector<std::uint64_t> bits_;
};

}  // namespace patchlight
