#pragma once

#include "solver/accuracy/coarse_transport.h"
#include "solver/hierarchy/cluster_exchange.h"
#include "solver/hierarchy/light_clusters.h"

#include <vector>

namespace patchlight {

/// Light on patches, carried from cluster to cluster: what a cluster's patches give off is taken
/// together, and what arrives at it arrives at each of them alike.
class ClusterTransport final : public CoarseTransport {
  public:
    /// `area` and `reflectance` of patches.
    ClusterTransport(LightClusters clusters, const ClusterExchange& exchange,
                     std::vector<double> area, Field reflectance);
    bool has_matrix() const override { return true; }
    bool is_exact() const override { return false; }
    Transported solve(const Field& exitance, double tolerance,
                      const Observe& observe) const override;
    std::optional<Field> once(const Field& radiosity) const override;

  private:
    Field to_clusters(const Field& of_patches) const;
    Field to_patches(const Field& of_clusters) const;

    LightClusters clusters_;
    std::vector<double> area_;  // of patches [m²]
    Field reflectance_;         // of patches [1]
    MatrixTransport between_;
};

}  // namespace patchlight
