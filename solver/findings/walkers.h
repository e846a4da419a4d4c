#pragma once

#include "solver/findings/flaw_search.h"

#include <array>
#include <span>
#include <vector>

namespace patchlight {

/// Light on its way through the scene, of which only the way is asked: every front sends it on in
/// a direction with density cosine / π, whatever its reflectance.
struct Walker {
    RayPoint origin = RayPoint::Zero();      // [ray space]
    FrameIndex frame = 0;                    // of `origin`
    RayPoint direction = RayPoint::UnitZ();  // unit
    std::uint64_t seed = 0;
    bool flying = true;
    // Of the last flight:
    Landing landing = Landing::escaped;
    SurfaceIndex surface = 0;         // landed on, unless it escaped
    RayPoint end = RayPoint::Zero();  // where, in the frame of that surface [ray space]
    float length = 0.0f;              // [ray space]
};

/// A number in [0, 1) out of a seed.
double uniform_of(std::uint64_t seed);

/// Uniform points over a surface.
class SurfacePoints {
  public:
    explicit SurfacePoints(const Surface& surface);
    Vec3 at(std::uint64_t seed) const;  // [m]

  private:
    const Surface& surface_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<double> up_to_;  // sum of areas up to each triangle [m²]
};

/// A walker that leaves point p of surface s on its front, or its back.
Walker leave(const FlawSearch& search, SurfaceIndex s, const Vec3& p, Side side,
             std::uint64_t seed);

/// One flight of each that is flying: in parallel.
void fly(const RayScene& rays, std::span<Walker> walkers);

/// Those that landed on a front turn to leave it; for the others the way is over.
void turn(const FlawSearch& search, std::span<Walker> walkers);

/// Surfaces drawn `count` times with probabilities in proportion to `weights`, evenly spread.
std::vector<SurfaceIndex> draw(const std::vector<double>& weights, std::size_t count,
                               std::uint64_t seed);

}  // namespace patchlight
