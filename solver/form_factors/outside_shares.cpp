#include "solver/form_factors/outside_shares.h"

#include <algorithm>

namespace patchlight {

namespace {

/// A cluster's mean share and how many rays' worth of evidence it lends to one of its patches.
struct Prior {
    double mean = 0.0;
    double strength = 0.0;  // [rays]
};

std::vector<Prior> cluster_priors(const std::vector<double>& shares,
                                  const std::vector<Outside>& outside,
                                  const PatchClusters& clusters) {
    struct Sums {
        double patches = 0.0, shares = 0.0, squares = 0.0, rays = 0.0;
    };
    std::vector<Sums> sums(clusters.size());
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (outside[i].rays == 0) continue;
        Sums& s = sums[clusters.of_patch[i]];
        s.patches += 1.0;
        s.shares += shares[i];
        s.squares += shares[i] * shares[i];
        s.rays = static_cast<double>(outside[i].rays);
    }
    std::vector<Prior> priors(sums.size());
    for (std::size_t c = 0; c < sums.size(); ++c) {
        if (sums[c].patches == 0.0) continue;
        const double mean = sums[c].shares / sums[c].patches;
        const double spread = sums[c].squares / sums[c].patches - mean * mean;
        const double chance = mean * (1.0 - mean);  // spread if patches were all or nothing
        const double strength = spread > 0.0 ? chance / spread - 1.0 : sums[c].rays;
        priors[c] = {mean, std::clamp(strength, 0.0, sums[c].rays)};
    }
    return priors;
}

constexpr double half_a_ray = 0.5;  // short of all is rounding [rays]

std::vector<double> share_variances(const std::vector<double>& shares,
                                    const std::vector<Outside>& outside,
                                    const PatchClusters& clusters,
                                    const std::vector<double>& row_sums) {
    const std::vector<Prior> priors = cluster_priors(shares, outside, clusters);
    std::vector<double> variances(shares.size(), 0.0);
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (outside[i].rays == 0) continue;
        const double n = static_cast<double>(outside[i].rays);
        const Prior& prior = priors[clusters.of_patch[i]];
        const double p = (n * shares[i] + prior.strength * prior.mean) / (n + prior.strength);
        const bool all = (1.0 - p) * n < half_a_ray;
        const double rest = all ? std::min(row_sums[i], 1.0) : 1.0 - p;
        variances[i] = (1.0 - rest) * rest / n;
    }
    return variances;
}

}  // namespace

void set_outside(ExchangeMatrix& matrix, const std::vector<Outside>& outside,
                 const PatchClusters& clusters, const std::vector<double>& row_sums) {
    for (const Outside& o : outside) {
        matrix.backs.push_back(o.backs);
        matrix.escaped.push_back(o.escaped);
    }
    matrix.backs_variance = share_variances(matrix.backs, outside, clusters, row_sums);
    matrix.escaped_variance = share_variances(matrix.escaped, outside, clusters, row_sums);
}

}  // namespace patchlight
