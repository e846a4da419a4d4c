#pragma once

#include "solver/form_factors/exchange_matrix.h"
#include "solver/hierarchy/light_clusters.h"
#include "solver/rays/ray_scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace patchlight {

/// Exchange between clusters: that of pairs, and what each sends to itself, for it need not be
/// flat.
struct ClusterExchange {
    ExchangeMatrix between;      // row sums + within + backs + escaped = 1
    std::vector<double> within;  // F_cc, per cluster [1]
};

/// By rays: origins uniform over a cluster's area, directions with density cosine over pi; every
/// ray lands on a cluster's front, on a back or outside, so closure holds, and both ends of a pair
/// are joined, so reciprocity holds. `rays` of each cluster; fewer if that would take longer than
/// `seconds`, as the first of them tell. `between.complete` is false if
/// `observe` stopped the work.
ClusterExchange find_cluster_exchange(const Scene& scene, const PatchMesh& mesh,
                                      const RayScene& ray_scene, const LightClusters& clusters,
                                      int rays, double seconds, std::uint64_t seed,
                                      const FractionObserver& observe);

}  // namespace patchlight
