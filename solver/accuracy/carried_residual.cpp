#include "solver/accuracy/carried_residual.h"

#include "solver/rays/cosine_directions.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <numbers>

namespace patchlight {

namespace {

constexpr int rays_of_point = 2 * ray_batch;  // for each half
constexpr int most_bounces = 16;              // of what is not alike everywhere little is left
constexpr double dies_out = 0.02;             // of the sum: what further bounces may add [1]
constexpr std::size_t most_points = 1024;     // that are carried
constexpr std::size_t most_direct = 384;      // of direct light, that are looked up
constexpr float same_side = 0.5f;             // least cosine between normals
constexpr double disk_over_share = 16.0;      // of the area that a point stands for
constexpr std::int32_t none = -1;

using Points = std::vector<ResidualPoint>;

/// Every so many of them, so that none is more likely.
Points thinned(const Points& points, std::size_t most) {
    if (points.size() <= most) return points;
    Points some;
    for (std::size_t k = 0; k < most; ++k) some.push_back(points[k * points.size() / most]);
    return some;
}

/// Finds the point that stands for a place: the nearest on the same object that faces the same way.
/// Points lie far denser where light is bright or steep: such a one stands for no place many widths
/// of its share of the area away.
class Nearest {
  public:
    Nearest(const Points& points, std::size_t objects) : of_object_(objects) {
        const double disk = disk_over_share / static_cast<double>(points.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            const GatherPoint& place = points[k].place;
            const double squared = disk / points[k].density / std::numbers::pi;
            of_object_[points[k].object].push_back(
                {place.position.cast<float>(), place.normal.cast<float>(),
                 static_cast<float>(squared), static_cast<std::int32_t>(k)});
        }
    }
    std::int32_t to(const Vec3& p, const Vec3& normal, ObjectIndex object) const {
        const Eigen::Vector3f at = p.cast<float>(), facing = normal.cast<float>();
        std::int32_t nearest = none;
        float least = std::numeric_limits<float>::infinity();
        for (const Place& place : of_object_[object]) {
            const float squared = (place.position - at).squaredNorm();
            if (squared >= least || squared > place.reach || place.normal.dot(facing) < same_side)
                continue;
            least = squared;
            nearest = place.number;
        }
        return nearest;
    }

  private:
    struct Place {
        Eigen::Vector3f position, normal;
        float reach;  // the disk's radius, squared [m²]
        std::int32_t number;
    };
    std::vector<std::vector<Place>> of_object_;
};

/// What the rays of one point land on.
struct Seen {
    std::array<std::int32_t, rays_of_point> indirect, direct;  // the nearest points, or none
    double outside = 0.0;  // share that lands on backs or escapes [1]
};

struct Carrier {
    const Scene& scene;
    const RayScene& rays;
    const EnergyReport& energy;
    Points points, direct;

    std::vector<Seen> look(std::uint64_t seed) const {
        const Nearest nearest(points, scene.objects.size()),
            nearest_direct(direct, scene.objects.size());
        const SobolPoints sobol(rays_of_point);
        std::vector<Seen> seen(points.size());
        tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
            RayBatch batch;
            LandingBatch landings;
            std::array<Lanes, 2> u;
            const GatherPoint& from = points[k].place;
            batch.ox.fill(from.origin.x());
            batch.oy.fill(from.origin.y());
            batch.oz.fill(from.origin.z());
            batch.frame.fill(from.frame);
            const std::uint64_t bits = mix(seed, k);
            for (int first = 0; first < rays_of_point; first += ray_batch) {
                scramble_lanes(
                    {sobol.reversed(0) + first, sobol.reversed(1) + first},
                    {static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(bits >> 32)}, u);
                cosine_directions(frame_about(from.normal.cast<float>()), u[0], u[1], batch);
                rays.land(batch, ray_batch, landings);
                for (int r = 0; r < ray_batch; ++r)
                    note(landings, r, static_cast<std::size_t>(first + r), nearest, nearest_direct,
                         seen[k]);
            }
        });
        return seen;
    }

    void note(const LandingBatch& landings, int r, std::size_t as, const Nearest& nearest,
              const Nearest& nearest_direct, Seen& seen) const {
        seen.indirect[as] = seen.direct[as] = none;
        if (landings.landing[r] != Landing::front) {
            seen.outside += 1.0 / rays_of_point;
            return;
        }
        const SurfaceIndex s = landings.surface[r];
        const Surface& surface = scene.surfaces[s];
        const Vec3 at =
            rays.from_ray_space(Vec3(landings.x[r], landings.y[r], landings.z[r]), rays.frame(s));
        seen.indirect[as] = nearest.to(at, surface.normal, surface.object);
        seen.direct[as] = nearest_direct.to(at, surface.normal, surface.object);
    }

    /// Irradiance that is missing at each point by one half of the residual [W/m²].
    std::vector<Rgb> missing(std::size_t half, const std::vector<Seen>& seen) const {
        std::vector<Rgb> sum, sent, sent_direct;
        for (const ResidualPoint& point : direct)
            sent_direct.push_back(point.reflectance * point.missing[half]);
        for (const ResidualPoint& point : points) {
            sum.push_back(point.missing[half]);
            sent.push_back(point.reflectance * point.missing[half]);
        }
        for (int bounce = 0; bounce < most_bounces; ++bounce) {
            std::vector<Rgb> next(points.size(), Rgb::Zero());
            double added = 0.0, all = 0.0;
            for (std::size_t k = 0; k < points.size(); ++k) {
                for (std::size_t r = 0; r < rays_of_point; ++r) {
                    const std::int32_t i = seen[k].indirect[r], d = seen[k].direct[r];
                    if (i != none) next[k] += sent[static_cast<std::size_t>(i)] / rays_of_point;
                    if (d != none && bounce == 0)
                        next[k] += sent_direct[static_cast<std::size_t>(d)] / rays_of_point;
                }
                sum[k] += next[k];
                added += next[k].matrix().squaredNorm() / points[k].density;
                all += sum[k].matrix().squaredNorm() / points[k].density;
            }
            for (std::size_t k = 0; k < points.size(); ++k)
                sent[k] = points[k].reflectance * next[k];
            if (added < dies_out * dies_out * all) break;
        }
        return sum;
    }

    /// Of values at points, what surfaces would absorb and what would go astray, ∫ dA [W].
    template <typename Value>
    Rgb lost(const std::vector<Seen>& seen, const Value& value) const {
        Rgb sum = Rgb::Zero();
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Rgb& reflectance = points[k].reflectance;
            sum += (1.0 - reflectance + seen[k].outside * reflectance) * value(k) /
                   (points[k].density * static_cast<double>(points.size()));
        }
        return sum;
    }

    /// What one point adds to such a sum of what is missing, mean of both halves [W].
    Rgb share_of(std::size_t k, const std::array<std::vector<Seen>, 2>& seen,
                 const std::array<std::vector<Rgb>, 2>& missing) const {
        const Rgb& reflectance = points[k].reflectance;
        const double outside = 0.5 * (seen[0][k].outside + seen[1][k].outside);
        return (1.0 - reflectance + outside * reflectance) * 0.5 * (missing[0][k] + missing[1][k]) /
               (points[k].density * static_cast<double>(points.size()));
    }

    /// Adds what is missing alike everywhere, so that all that is missing would be lost as the
    /// energy says, as far as that is the surer number. Returns the variance of what was added,
    /// over the displayed light, that both numbers leave [1].
    Rgb heed_energy(const std::array<std::vector<Seen>, 2>& seen,
                    std::array<std::vector<Rgb>, 2>& missing) const {
        std::array<Rgb, 2> sum, whole;
        for (std::size_t h = 0; h < 2; ++h) {
            sum[h] = lost(seen[h], [&](std::size_t k) { return missing[h][k]; });
            whole[h] = lost(seen[h], [&](std::size_t k) { return points[k].light; }).max(1e-300);
        }
        const Rgb mean = 0.5 * (sum[0] + sum[1]) / static_cast<double>(points.size());
        Rgb variance = Rgb::Zero();
        for (std::size_t k = 0; k < points.size(); ++k)
            variance += (share_of(k, seen, missing) - mean).square();
        variance = variance.max(0.5 * (sum[0] - sum[1]).square());
        const Rgb noise = (energy.standard_error * energy.emitted).square();
        for (std::size_t h = 0; h < 2; ++h) {
            const Rgb share = (energy.missing() - sum[h]) * (variance + 1e-300) /
                              (variance + noise + 1e-300) / whole[h];
            for (std::size_t k = 0; k < points.size(); ++k)
                missing[h][k] += share * points[k].light;
        }
        return variance * noise / (variance + noise + 1e-300) / (whole[0] * whole[1]);
    }
};

}  // namespace

MeasuredError carried_residual(const Scene& scene, const RayScene& rays, const CheckReport& checks,
                               const EnergyReport& energy, std::uint64_t seed) {
    const Carrier carrier{scene, rays, energy, thinned(checks.indirect_points, most_points),
                          thinned(checks.direct_points, most_direct)};
    std::array<std::vector<Seen>, 2> seen;
    std::array<std::vector<Rgb>, 2> missing;
    for (std::size_t h = 0; h < 2; ++h) {
        seen[h] = carrier.look(mix(seed, h));
        missing[h] = carrier.missing(h, seen[h]);
    }
    const Rgb doubt = carrier.heed_energy(seen, missing).sqrt();
    std::vector<double> products;
    for (std::size_t k = 0; k < carrier.points.size(); ++k) {
        const ResidualPoint& point = carrier.points[k];
        const double alike = luminance(point.reflectance * doubt * point.light);
        products.push_back((luminance(point.reflectance * missing[0][k]) *
                                luminance(point.reflectance * missing[1][k]) +
                            alike * alike) /
                           point.density);
    }
    return mean_of(products);
}

}  // namespace patchlight
