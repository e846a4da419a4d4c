#pragma once

#include "solver/scene/coplanar.h"
#include "solver/scene/polygon.h"
#include "solver/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace patchlight {

/// Rays travel in ray space: the scene centred and scaled to [-1, 1], in double, before it is
/// rounded to the float that Embree sees.
using RayPoint = Eigen::Vector3f;

constexpr int ray_batch = 16;  // rays traced together

struct alignas(64) RayBatch {
    std::array<float, ray_batch> ox, oy, oz;  // origins
    std::array<float, ray_batch> dx, dy, dz;  // directions, any length
};

enum class Landing : std::uint8_t { escaped, back, front };

struct alignas(64) LandingBatch {
    std::array<Landing, ray_batch> landing;
    std::array<SurfaceIndex, ray_batch> surface;  // where it landed, unless it escaped
    std::array<float, ray_batch> x, y, z;         // where, in ray space
};

/// The scene's polygons as Embree sees them, whole and not cut into patches: fewer triangles, and
/// no crack between patches. Safe to use from several threads.
class RayScene {
  public:
    /// `instructions` limits Embree to a set of them, such as "avx2"; empty: the best there are.
    RayScene(const Scene& scene, const CoplanarOverlaps& overlaps,
             const std::string& instructions = {});
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    RayPoint to_ray_space(const Vec3& p) const { return ((p - centre_) * scale_).cast<float>(); }
    Vec3 from_ray_space(const Vec3& p) const { return p / scale_ + centre_; }
    double scale() const { return scale_; }  // ray space per metre [1/m]

    /// How far above surface s a ray must start, so as to leave behind what touches it there:
    /// more where another polygon lies in the same plane [ray space].
    float lift(SurfaceIndex s) const { return lift_[s]; }
    /// Surfaces closer than this are in contact: 1e-6 of the scene's size [ray space].
    float contact() const { return contact_; }

    /// What each of the first `count` rays lands on. Of coinciding surfaces it is a front that
    /// faces the ray, the one listed last; a back only if no front is there.
    void land(const RayBatch& rays, int count, LandingBatch& landings) const;

    /// Which of the first `count` segments origin -> origin + direction meet a surface: bit k.
    std::uint32_t blocked(const RayBatch& segments, int count) const;

  private:
    struct Device;
    void find_lifts(const Scene& scene, const CoplanarOverlaps& overlaps);
    void build(const Scene& scene);
    void resolve_contact(LandingBatch& landings, int k, const RayPoint& direction) const;
    void resolve_edge(LandingBatch& landings, int k, const RayPoint& origin,
                      std::uint32_t triangle) const;
    void set_landing(LandingBatch& landings, int k, SurfaceIndex s, const RayPoint& at,
                     const RayPoint& direction) const;

    struct Outline {  // of a surface that shares its plane with others
        PlaneFrame frame;
        std::vector<Vec2> corners;
    };

    Vec3 centre_ = Vec3::Zero();
    double scale_ = 1.0;
    float contact_ = 0.0f;
    std::vector<float> lift_;
    std::vector<RayPoint> normals_;  // of surfaces
    struct Triangle {
        SurfaceIndex surface = 0;
        RayPoint centre;
        float edge_share = 0.0f;  // of a height: nearer an edge is in contact with it [1]
    };
    Triangle make_triangle(SurfaceIndex s, const RayPoint& a, const RayPoint& b,
                           const RayPoint& c) const;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<SurfaceIndex>> partners_;
    std::vector<Outline> outlines_;  // in ray space; empty where there are no partners
    std::unique_ptr<Device> device_;
};

}  // namespace patchlight
