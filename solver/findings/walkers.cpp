#include "solver/findings/walkers.h"

#include "solver/rays/cosine_directions.h"
#include "solver/rays/low_discrepancy.h"
#include "solver/scene/polygon.h"

#include <oneapi/tbb/parallel_for.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

RayPoint cosine_direction(const RayPoint& normal, std::uint64_t seed) {
    const RayFrame frame = frame_about(normal);
    const auto u = static_cast<float>(uniform_of(mix(seed, 1)));
    const auto angle =
        2.0f * std::numbers::pi_v<float> * static_cast<float>(uniform_of(mix(seed, 2)));
    const float r = std::sqrt(u);
    return r * std::cos(angle) * frame.tangent + r * std::sin(angle) * frame.bitangent +
           std::sqrt(1.0f - u) * frame.normal;
}

void fly_batch(const RayScene& rays, std::span<Walker*> walkers) {
    RayBatch batch{};
    LandingBatch landings{};
    for (std::size_t k = 0; k < walkers.size(); ++k) {
        const Walker& walker = *walkers[k];
        batch.ox[k] = walker.origin.x(), batch.oy[k] = walker.origin.y();
        batch.oz[k] = walker.origin.z();
        batch.dx[k] = walker.direction.x(), batch.dy[k] = walker.direction.y();
        batch.dz[k] = walker.direction.z();
        batch.frame[k] = walker.frame;
    }
    rays.land(batch, static_cast<int>(walkers.size()), landings);
    for (std::size_t k = 0; k < walkers.size(); ++k) {
        Walker& walker = *walkers[k];
        walker.landing = landings.landing[k];
        if (walker.landing == Landing::escaped) continue;
        walker.surface = landings.surface[k];
        walker.end = RayPoint(landings.x[k], landings.y[k], landings.z[k]);
        const RayPoint shift = rays.shift(rays.frame(walker.surface), walker.frame).cast<float>();
        walker.length = (walker.end + shift - walker.origin).norm();
    }
}

}  // namespace

double uniform_of(std::uint64_t seed) { return static_cast<double>(mix(seed, 0) >> 11) * 0x1p-53; }

SurfacePoints::SurfacePoints(const Surface& surface) : surface_(surface) {
    if (surface.corners.size() == 3) {
        triangles_ = {{0, 1, 2}};
    } else {
        const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
        std::vector<Vec2> flat;
        for (const Vec3& p : surface.corners) flat.push_back(frame.flat(p));
        triangles_ = triangulate(flat);
    }
    double sum = 0.0;
    for (const auto& t : triangles_) {
        const std::vector<Vec3>& p = surface.corners;
        up_to_.push_back(sum += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm());
    }
}

Vec3 SurfacePoints::at(std::uint64_t seed) const {
    const double drawn = uniform_of(mix(seed, 3)) * up_to_.back();
    const auto found = std::upper_bound(up_to_.begin(), up_to_.end() - 1, drawn);
    const auto& t = triangles_[static_cast<std::size_t>(found - up_to_.begin())];
    const std::vector<Vec3>& p = surface_.corners;
    const double root = std::sqrt(uniform_of(mix(seed, 4))), v = uniform_of(mix(seed, 5));
    return (1.0 - root) * p[t[0]] + root * (1.0 - v) * p[t[1]] + root * v * p[t[2]];
}

Walker leave(const FlawSearch& search, SurfaceIndex s, const Vec3& p, Side side,
             std::uint64_t seed) {
    const RayPoint normal =
        (side == Side::front ? 1.0f : -1.0f) * search.scene.surfaces[s].normal.cast<float>();
    Walker walker;
    walker.frame = search.rays.frame(s);
    walker.origin = search.rays.to_ray_space(p, walker.frame) + search.rays.lift(s) * normal;
    walker.direction = cosine_direction(normal, seed);
    walker.seed = seed;
    return walker;
}

void fly(const RayScene& rays, std::span<Walker> walkers) {
    std::vector<Walker*> flying;
    for (Walker& walker : walkers)
        if (walker.flying) flying.push_back(&walker);
    const std::size_t batches = (flying.size() + ray_batch - 1) / ray_batch;
    tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t b) {
        const std::size_t first = b * ray_batch;
        fly_batch(rays, std::span(flying).subspan(
                            first, std::min<std::size_t>(ray_batch, flying.size() - first)));
    });
}

void turn(const FlawSearch& search, std::span<Walker> walkers) {
    for (Walker& walker : walkers) {
        if (!walker.flying) continue;
        walker.flying = walker.landing == Landing::front;
        if (!walker.flying) continue;
        const RayPoint normal = search.scene.surfaces[walker.surface].normal.cast<float>();
        walker.seed = mix(walker.seed, 6);
        walker.frame = search.rays.frame(walker.surface);
        walker.origin = walker.end + search.rays.lift(walker.surface) * normal;
        walker.direction = cosine_direction(normal, walker.seed);
    }
}

std::vector<SurfaceIndex> draw(const std::vector<double>& weights, std::size_t count,
                               std::uint64_t seed) {
    double total = 0.0;
    for (const double weight : weights) total += weight;
    std::vector<SurfaceIndex> drawn;
    if (!(total > 0.0)) return drawn;
    const double shift = uniform_of(seed);
    double reached = 0.0;
    for (SurfaceIndex s = 0; s < weights.size(); ++s) {
        reached += weights[s] / total * static_cast<double>(count);
        while (drawn.size() < count && static_cast<double>(drawn.size()) + shift < reached)
            drawn.push_back(s);
    }
    return drawn;
}

}  // namespace patchlight
