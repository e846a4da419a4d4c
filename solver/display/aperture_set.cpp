#include "solver/display/aperture_set.h"

#include "solver/form_factors/point_factor.h"
#include "solver/rays/wide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr std::size_t most_glows = 16;
constexpr float near = 1e-6f;      // distance that is taken for no less [ray space]
constexpr float widened = 1.001f;  // of spheres, for rounding
constexpr float rounded = 1e-6f;   // of angles

using Columns = std::array<const float*, 17>;

/// See Aperture::crosses.
PATCHLIGHT_WIDE int crossed(const Columns& of, int count, float ox, float oy, float oz, float dx,
                            float dy, float dz) {
    const float *cx = of[0], *cy = of[1], *cz = of[2], *nx = of[3], *ny = of[4], *nz = of[5],
                *ux = of[6], *uy = of[7], *uz = of[8], *vx = of[9], *vy = of[10], *vz = of[11];
    int sum = 0;
    for (int g = 0; g < count; ++g) {
        const float qx = cx[g] - ox, qy = cy[g] - oy, qz = cz[g] - oz;
        const float along = dx * nx[g] + dy * ny[g] + dz * nz[g],
                    above = qx * nx[g] + qy * ny[g] + qz * nz[g], t = above / along;
        const float px = t * dx - qx, py = t * dy - qy, pz = t * dz - qz;
        const float u = px * ux[g] + py * uy[g] + pz * uz[g],
                    v = px * vx[g] + py * vy[g] + pz * vz[g];
        sum += static_cast<int>(above * along > 0.0f) & static_cast<int>(t < 1.0f) &
               static_cast<int>(u >= 0.0f) & static_cast<int>(u < 1.0f) &
               static_cast<int>(v >= 0.0f) & static_cast<int>(v < 1.0f);
    }
    return sum;
}

struct Sight {                           // of a sphere of sources, from a point
    float x = 0.0f, y = 0.0f, z = 0.0f;  // unit, towards its centre
    float sine = 0.0f, cosine = 1.0f;    // of its angular radius
    float farthest = 0.0f, exitance = 0.0f;
};

/// Greatest irradiance through each, where the cones round it and round the sources touch.
PATCHLIGHT_WIDE void bound(const Columns& of, int count, const float* origin, const float* normal,
                           const Sight& sight, float* most) {
    const float *mx = of[12], *my = of[13], *mz = of[14], *nx = of[3], *ny = of[4], *nz = of[5],
                *radius = of[15], *area = of[16];
    const float ox = origin[0], oy = origin[1], oz = origin[2];
    const float ax = normal[0], ay = normal[1], az = normal[2];
    for (int g = 0; g < count; ++g) {
        const float qx = mx[g] - ox, qy = my[g] - oy, qz = mz[g] - oz, r = radius[g];
        const float squared = qx * qx + qy * qy + qz * qz,
                    distance = std::sqrt(std::max(squared, near * near)), over = 1.0f / distance;
        const float sine = std::min(1.0f, r * over),
                    cosine = std::sqrt(std::max(0.0f, 1.0f - sine * sine));
        // By sines, as cosines of small angles are all one.
        const float kx = qy * sight.z - qz * sight.y, ky = qz * sight.x - qx * sight.z,
                    kz = qx * sight.y - qy * sight.x;
        const float ahead = qx * sight.x + qy * sight.y + qz * sight.z,
                    aside = std::sqrt(kx * kx + ky * ky + kz * kz) * over,
                    both = sine * sight.cosine + cosine * sight.sine;
        const float height = qx * ax + qy * ay + qz * az + r,
                    across = std::abs(qx * nx[g] + qy * ny[g] + qz * nz[g]) + r,
                    least = std::max(near, distance - r), over_least = 1.0f / least;
        const float factor = std::min(1.0f, height * over_least) *
                             std::min(1.0f, across * over_least) * area[g] * over_least *
                             over_least / std::numbers::pi_v<float>;
        const int wide = static_cast<int>(cosine * sight.cosine <= sine * sight.sine),
                  touch = static_cast<int>(ahead > 0.0f) &
                          static_cast<int>(aside <= widened * both + rounded);
        const bool seen =
            static_cast<bool>(static_cast<int>(height > 0.0f) &
                              static_cast<int>(distance - r < sight.farthest) & (wide | touch));
        const float light = seen ? std::min(1.0f, factor) * sight.exitance : 0.0f;
        most[g] = std::max(most[g], light);
    }
}

}  // namespace

ApertureSet::ApertureSet(const std::vector<Aperture>& apertures,
                         const std::vector<LightSource>& sources, const RayScene& rays) {
    for (const Aperture& aperture : apertures) add(aperture);
    if (empty()) return;
    find_lit(sources, rays);
    find_glows(sources, rays);
}

void ApertureSet::add(const Aperture& aperture) {
    apertures_.push_back(aperture);
    const auto put = [&](Field at, const RayPoint& p) {
        for (std::size_t k = 0; k < 3; ++k)
            side_by_side_[at + k].push_back(p[static_cast<Eigen::Index>(k)]);
    };
    put(corner_x, aperture.corner);
    put(normal_x, aperture.normal);
    put(first_x, aperture.first_of);
    put(second_x, aperture.second_of);
    put(middle_x, aperture.at(0.5f, 0.5f));
    side_by_side_[radius].push_back(widened * 0.5f *
                                    (aperture.first_edge + aperture.second_edge).norm());
    side_by_side_[area].push_back(aperture.area);
}

namespace {

template <typename Fields>
Columns columns_of(const Fields& fields) {
    Columns columns{};
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k] = fields[k].data();
    return columns;
}

}  // namespace

int ApertureSet::count_crossed(const RayPoint& origin, const RayPoint& ray) const {
    if (empty()) return 0;
    return crossed(columns_of(side_by_side_), static_cast<int>(size()), origin.x(), origin.y(),
                   origin.z(), ray.x(), ray.y(), ray.z());
}

void ApertureSet::most_through(const RayPoint& origin, const RayPoint& normal,
                               std::span<float> most) const {
    std::fill(most.begin(), most.end(), 0.0f);
    const Columns columns = columns_of(side_by_side_);
    for (const Glow& glow : glows_) {
        const RayPoint to = glow.centre - origin;
        const float distance = std::max(near, to.norm()), sine = glow.radius / distance;
        if (to.dot(normal) + glow.radius <= 0.0f) continue;
        const Sight sight{to.x() / distance,
                          to.y() / distance,
                          to.z() / distance,
                          std::min(1.0f, sine),
                          std::sqrt(std::max(0.0f, 1.0f - sine * sine)),
                          distance + glow.radius,
                          glow.exitance};
        bound(columns, static_cast<int>(size()), origin.data(), normal.data(), sight, most.data());
    }
}

void ApertureSet::find_lit(const std::vector<LightSource>& sources, const RayScene& rays) {
    for (const Aperture& aperture : apertures_) {
        const Vec3 centre = rays.from_ray_space(aperture.at(0.5f, 0.5f).cast<double>()),
                   normal = aperture.normal.cast<double>();
        std::array<Lit, 2> lit;
        for (const LightSource& source : sources)
            for (std::size_t side = 0; side < 2; ++side) {
                const double factor = point_factor(centre, side == 0 ? normal : Vec3(-normal),
                                                   source.polygon, source.normal);
                lit[side].factor += factor;
                lit[side].irradiance += factor * luminance(source.exitance);
            }
        lit_.push_back(lit);
    }
}

/// The largest sphere is cut across its longest side, until there are many or one for each.
void ApertureSet::find_glows(const std::vector<LightSource>& sources, const RayScene& rays) {
    struct Group {
        std::vector<std::size_t> sources;
        RayPoint low, high;
        float size() const { return (high - low).norm(); }
    };
    const auto corners_of = [&](std::size_t s, auto&& use) {
        const ConvexPolygon& polygon = sources[s].polygon;
        for (std::size_t k = 0; k < polygon.size; ++k)
            use(rays.to_ray_space(polygon.corners[k], sources[s].sampler.frame));
    };
    const auto make_group = [&](std::vector<std::size_t> of) {
        Group group{std::move(of), RayPoint::Constant(1e30f), RayPoint::Constant(-1e30f)};
        for (const std::size_t s : group.sources)
            corners_of(s, [&](const RayPoint& p) {
                group.low = group.low.cwiseMin(p);
                group.high = group.high.cwiseMax(p);
            });
        return group;
    };
    std::vector<std::size_t> every(sources.size());
    for (std::size_t s = 0; s < every.size(); ++s) every[s] = s;
    std::vector<Group> groups;
    if (!every.empty()) groups.push_back(make_group(every));
    while (!groups.empty() && groups.size() < most_glows) {
        const auto largest =
            std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
                return (a.sources.size() > 1 ? a.size() : 0.0f) <
                       (b.sources.size() > 1 ? b.size() : 0.0f);
            });
        if (largest->sources.size() < 2) break;
        Eigen::Index axis = 0;
        (largest->high - largest->low).maxCoeff(&axis);
        std::vector<std::size_t> all = largest->sources;
        const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
        std::nth_element(all.begin(), middle, all.end(), [&](std::size_t a, std::size_t b) {
            return sources[a].sampler.at(0.5f, 0.5f)[axis] <
                   sources[b].sampler.at(0.5f, 0.5f)[axis];
        });
        *largest = make_group({all.begin(), middle});
        groups.push_back(make_group({middle, all.end()}));
    }
    for (const Group& group : groups) {
        Glow glow{0.5f * (group.low + group.high), 0.0f, 0.0f};
        for (const std::size_t s : group.sources) {
            corners_of(s, [&](const RayPoint& p) {
                glow.radius = std::max(glow.radius, widened * (p - glow.centre).norm());
            });
            glow.exitance =
                std::max(glow.exitance, static_cast<float>(luminance(sources[s].exitance)));
        }
        glows_.push_back(glow);
    }
}

}  // namespace patchlight
