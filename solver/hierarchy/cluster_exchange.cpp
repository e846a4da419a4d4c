#include "solver/hierarchy/cluster_exchange.h"

#include "solver/form_factors/join_halves.h"
#include "solver/form_factors/repair_closure.h"
#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/rays/patch_locator.h"
#include "solver/rays/patch_sampler.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>

namespace patchlight {

namespace {

constexpr std::size_t rows_at_a_time = 256;  // between two words to the observer
constexpr int fewest_rays = 16;              // of a cluster, however little time there is

struct ClusterRow {
    std::vector<std::uint32_t> columns;  // ascending, with the cluster itself
    std::vector<std::uint32_t> hits;
    std::uint32_t backs = 0, escaped = 0;
};

/// Rays that leave a cluster as its light does. Ray k of n starts on the patch that holds share
/// k/n of its area, so that each gets as many as it is large; the rest of its place and its
/// direction are those of scrambled Sobol points.
class ClusterRays {
  public:
    ClusterRays(const Scene& scene, const PatchMesh& mesh, const RayScene& rays,
                const LightClusters& clusters, int count, std::uint64_t seed)
        : scene_(scene),
          mesh_(mesh),
          rays_(rays),
          clusters_(clusters),
          locator_(scene, mesh, rays),
          points_(static_cast<std::size_t>(count)),
          seed_(seed) {}

    ClusterRow row(std::size_t c) const {
        const auto members = clusters_.members(c);
        const auto count = static_cast<int>(points_.size());
        const double step = clusters_.area[c] / count;
        double reached = unit(mix(seed_, 3 * c)) * step;  // of the area, by the next ray
        double passed = 0.0;                              // of the area, before the patch in hand
        ClusterRow row;
        std::vector<std::uint32_t> landed;
        RayBatch batch;
        LandingBatch landings;
        int ray = 0, filled = 0;
        const auto trace = [&] {
            rays_.land(batch, filled, landings);
            for (int k = 0; k < filled; ++k) count_landing(landings, k, row, landed);
            filled = 0;
        };
        for (std::size_t m = 0; m < members.size() && ray < count; ++m) {
            const double end = passed + mesh_.patches[members[m]].area;
            if (reached < end || m + 1 == members.size()) {
                const SurfaceIndex s = mesh_.patches[members[m]].surface;
                const PatchSampler sampler =
                    make_sampler(mesh_, members[m], scene_.surfaces[s].normal, rays_);
                const RayPoint lift = rays_.lift(s) * sampler.normal;
                for (; ray < count && (reached < end || m + 1 == members.size());
                     ++ray, reached += step) {
                    start_ray(c, ray, sampler, lift, batch, filled++);
                    if (filled == ray_batch) trace();
                }
            }
            passed = end;
        }
        if (filled > 0) trace();
        tally(landed, row);
        return row;
    }

  private:
    void start_ray(std::size_t c, int ray, const PatchSampler& sampler, const RayPoint& lift,
                   RayBatch& batch, int k) const {
        const std::uint64_t low = mix(seed_, 3 * c + 1), high = mix(seed_, 3 * c + 2);
        const auto at = static_cast<std::size_t>(ray);
        const auto u = [&](std::size_t d, std::uint64_t word) {
            return points_.at(d, at, static_cast<std::uint32_t>(word));
        };
        const RayPoint origin = sampler.at(u(0, low), u(1, low >> 32)) + lift;
        const RayPoint direction = cosine_direction(
            {sampler.tangent, sampler.bitangent, sampler.normal}, u(2, high), u(3, high >> 32));
        batch.ox[k] = origin.x(), batch.oy[k] = origin.y(), batch.oz[k] = origin.z();
        batch.dx[k] = direction.x(), batch.dy[k] = direction.y(), batch.dz[k] = direction.z();
        batch.frame[k] = sampler.frame;
    }

    void count_landing(const LandingBatch& landings, int k, ClusterRow& row,
                       std::vector<std::uint32_t>& landed) const {
        switch (landings.landing[k]) {
            case Landing::escaped:
                ++row.escaped;
                break;
            case Landing::back:
                ++row.backs;
                break;
            case Landing::front:
                landed.push_back(clusters_.of_patch[locator_.find(
                    landings.surface[k], landings.x[k], landings.y[k], landings.z[k])]);
                break;
        }
    }

    static void tally(std::vector<std::uint32_t>& landed, ClusterRow& row) {
        std::sort(landed.begin(), landed.end());
        for (std::size_t k = 0; k < landed.size();) {
            std::size_t end = k;
            while (end < landed.size() && landed[end] == landed[k]) ++end;
            row.columns.push_back(landed[k]);
            row.hits.push_back(static_cast<std::uint32_t>(end - k));
            k = end;
        }
    }

    const Scene& scene_;
    const PatchMesh& mesh_;
    const RayScene& rays_;
    const LightClusters& clusters_;
    PatchLocator locator_;
    SobolPoints points_;
    std::uint64_t seed_;
};

void append(const ClusterRow& row, std::size_t c, int rays, ClusterExchange& exchange) {
    ExchangeMatrix& matrix = exchange.between;
    const double n = rays, area = matrix.area[c];
    const auto variance = [n](double share) { return share * (1.0 - share) / n; };
    double within = 0.0;
    for (std::size_t k = 0; k < row.columns.size(); ++k) {
        const double share = row.hits[k] / n;
        if (row.columns[k] == c) {
            within = share;
            continue;
        }
        matrix.column.push_back(row.columns[k]);
        matrix.exchange.push_back(static_cast<float>(area * share));
        matrix.variance.push_back(static_cast<float>(area * area * variance(share)));
        matrix.ceiling.push_back(static_cast<float>(std::min(area, matrix.area[row.columns[k]])));
    }
    matrix.start.push_back(matrix.column.size());
    const double escaped = row.escaped / n + within;  // for now: neither goes to another
    exchange.within.push_back(within);
    matrix.backs.push_back(row.backs / n);
    matrix.escaped.push_back(escaped);
    matrix.backs_variance.push_back(variance(row.backs / n));
    matrix.escaped_variance.push_back(variance(escaped));
    matrix.rays += static_cast<std::uint64_t>(rays);
}

/// Rays of a cluster that all of them can be given in time.
int affordable(const ClusterRays& from, std::size_t clusters, int rays, double seconds) {
    if (!std::isfinite(seconds)) return rays;
    const std::size_t probes = std::min(clusters, rows_at_a_time), apart = clusters / probes;
    const auto began = std::chrono::steady_clock::now();
    tbb::parallel_for(std::size_t{0}, probes, [&](std::size_t k) { from.row(k * apart); });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
    const double all = took.count() * static_cast<double>(clusters) / static_cast<double>(probes);
    const double share = seconds / std::max(all, 1e-9);
    return share >= 1.0 ? rays
                        : std::max(std::min(rays, fewest_rays), static_cast<int>(share * rays));
}

}  // namespace

ClusterExchange find_cluster_exchange(const Scene& scene, const PatchMesh& mesh,
                                      const RayScene& ray_scene, const LightClusters& clusters,
                                      int rays, double seconds, std::uint64_t seed,
                                      const FractionObserver& observe) {
    rays = affordable(ClusterRays(scene, mesh, ray_scene, clusters, rays, seed), clusters.size(),
                      rays, seconds);
    const ClusterRays from(scene, mesh, ray_scene, clusters, rays, seed);
    ClusterExchange exchange;
    ExchangeMatrix& matrix = exchange.between;
    const std::size_t n = clusters.size();
    matrix.unit =
        std::accumulate(clusters.area.begin(), clusters.area.end(), 0.0) / static_cast<double>(n);
    for (const double area : clusters.area) matrix.area.push_back(area / matrix.unit);
    matrix.start.push_back(0);
    std::vector<ClusterRow> rows(rows_at_a_time);
    for (std::size_t first = 0; first < n; first += rows_at_a_time) {
        const std::size_t count = std::min(rows_at_a_time, n - first);
        tbb::parallel_for(std::size_t{0}, count,
                          [&](std::size_t k) { rows[k] = from.row(first + k); });
        for (std::size_t k = 0; k < count; ++k) append(rows[k], first + k, rays, exchange);
        if (!observe(static_cast<double>(first + count) / static_cast<double>(n))) {
            matrix.complete = false;
            return exchange;
        }
    }
    join_halves(matrix, std::vector<int>(n, 1));
    repair_closure(matrix);
    for (std::size_t c = 0; c < n; ++c) {
        exchange.within[c] = std::min(exchange.within[c], matrix.escaped[c]);
        matrix.escaped[c] -= exchange.within[c];
    }
    return exchange;
}

}  // namespace patchlight
