#include "solver/accuracy/cluster_transport.h"

#include <utility>

namespace patchlight {

namespace {

/// Area-weighted means over the patches of each cluster.
Field means_of(const LightClusters& clusters, const std::vector<double>& area,
               const Field& of_patches) {
    Field means(of_patches.size(), std::vector<double>(clusters.size(), 0.0));
    for (std::size_t channel = 0; channel < of_patches.size(); ++channel)
        for (std::size_t c = 0; c < clusters.size(); ++c) {
            for (const PatchIndex i : clusters.members(c))
                means[channel][c] += area[i] * of_patches[channel][i];
            means[channel][c] /= clusters.area[c];
        }
    return means;
}

}  // namespace

ClusterTransport::ClusterTransport(LightClusters clusters, const ClusterExchange& exchange,
                                   std::vector<double> area, Field reflectance)
    : clusters_(std::move(clusters)),
      area_(std::move(area)),
      reflectance_(std::move(reflectance)),
      between_(exchange.between, clusters_.area, to_clusters(reflectance_), false,
               exchange.within) {}

Field ClusterTransport::to_clusters(const Field& of_patches) const {
    return means_of(clusters_, area_, of_patches);
}

Field ClusterTransport::to_patches(const Field& of_clusters) const {
    Field of_patches(of_clusters.size(), std::vector<double>(area_.size(), 0.0));
    for (std::size_t channel = 0; channel < of_clusters.size(); ++channel)
        for (const PatchIndex i : clusters_.patches)
            of_patches[channel][i] = of_clusters[channel][clusters_.of_patch[i]];
    return of_patches;
}

Transported ClusterTransport::solve(const Field& exitance, double tolerance,
                                    const Observe& observe) const {
    Transported found = between_.solve(to_clusters(exitance), tolerance, observe);
    found.irradiance = to_patches(found.irradiance);
    found.radiosity = exitance;
    for (std::size_t channel = 0; channel < exitance.size(); ++channel)
        for (std::size_t i = 0; i < area_.size(); ++i)
            found.radiosity[channel][i] += reflectance_[channel][i] * found.irradiance[channel][i];
    return found;
}

std::optional<Field> ClusterTransport::once(const Field& radiosity) const {
    return to_patches(*between_.once(to_clusters(radiosity)));
}

}  // namespace patchlight
