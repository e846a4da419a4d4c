#pragma once

#include "solver/scene/coplanar.h"
#include "solver/scene/local_tolerance.h"
#include "solver/scene/polygon.h"
#include "solver/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace patchlight {

/// Rays travel in ray space: each frame of the scene centred and scaled in double, before it is
/// rounded to the float that Embree sees. The scale is one for all: the smallest frame, mostly the
/// only one, lies in [-1, 1].
using RayPoint = Eigen::Vector3f;

constexpr int ray_batch = 16;  // rays traced together

struct alignas(64) RayBatch {
    std::array<float, ray_batch> ox, oy, oz;  // origins
    std::array<float, ray_batch> dx, dy, dz;  // directions, any length
    std::array<float, ray_batch> ex, ey, ez;  // ends of segments to another frame, in that
    std::array<FrameIndex, ray_batch> frame{}, end_frame{};
};

enum class Landing : std::uint8_t { escaped, back, front };

struct alignas(64) LandingBatch {
    std::array<Landing, ray_batch> landing;
    std::array<SurfaceIndex, ray_batch> surface;  // where it landed, unless it escaped
    std::array<float, ray_batch> x, y, z;         // where, in the frame of that surface
};

class EmbreeScene;

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

    std::size_t frames() const { return tolerance_.frames().size(); }
    FrameIndex frame(SurfaceIndex s) const { return tolerance_.frame_of(s); }
    /// The frame in which rays from p are known best.
    FrameIndex frame_at(const Vec3& p) const { return tolerance_.frame_at(p); }
    RayPoint to_ray_space(const Vec3& p, FrameIndex f = 0) const {
        return ((p - origins_[f]) * scale_).cast<float>();
    }
    Vec3 from_ray_space(const Vec3& p, FrameIndex f = 0) const { return p / scale_ + origins_[f]; }
    /// What is added to a point of frame `of` to have it in frame `to` [ray space].
    Vec3 shift(FrameIndex of, FrameIndex to) const {
        return (origins_[of] - origins_[to]) * scale_;
    }
    double scale() const { return scale_; }  // ray space per metre [1/m]

    /// How far above surface s a ray must start, so as to leave behind what touches it there:
    /// more where another polygon lies in the same plane [ray space].
    float lift(SurfaceIndex s) const { return lift_[s]; }
    /// A step of float where surface s is [ray space].
    double step(SurfaceIndex s) const { return tolerance_.step(s) * scale_; }
    /// Surfaces closer than this to a point among those that a frame is made for are in contact
    /// with it [ray space].
    float contact(FrameIndex f = 0) const {
        return static_cast<float>(tolerance_.at_point(f) * scale_);
    }

    /// Surfaces closer than this to p, told in a frame, are in contact with it [ray space].
    float contact_at(const Vec3& p, FrameIndex f) const;

    /// Lane k becomes a segment from a point of one frame to a point of another; `way` is what
    /// leads there from the first.
    static void set_segment(RayBatch& batch, int k, const RayPoint& from, FrameIndex frame,
                            const RayPoint& way, const RayPoint& to, FrameIndex end_frame) {
        batch.ox[k] = from.x(), batch.oy[k] = from.y(), batch.oz[k] = from.z();
        batch.dx[k] = way.x(), batch.dy[k] = way.y(), batch.dz[k] = way.z();
        batch.frame[k] = frame, batch.end_frame[k] = end_frame;
        if (frame == end_frame) return;
        batch.ex[k] = to.x(), batch.ey[k] = to.y(), batch.ez[k] = to.z();
    }

    /// What each of the first `count` rays lands on. Of coinciding surfaces it is a front that
    /// faces the ray, the one listed last; a back only if no front is there.
    void land(const RayBatch& rays, int count, LandingBatch& landings) const;

    /// Which of the first `count` segments origin -> origin + direction meet a surface: bit k. One
    /// that leads to another frame is followed from both its ends to the middle.
    std::uint32_t blocked(const RayBatch& segments, int count) const;

  private:
    struct Triangle {
        SurfaceIndex surface = 0;
        RayPoint centre;
        float edge_share = 0.0f;  // of a height: nearer an edge is in contact with it [1]
    };
    struct Outline {  // of a surface that shares its plane with others
        PlaneFrame frame;
        std::vector<Vec2> corners;
    };
    using Corners = std::array<RayPoint, 3>;

    void find_lifts(const Scene& scene, const CoplanarOverlaps& overlaps);
    void build(const Scene& scene);
    void land_between_frames(const RayBatch& rays, int count, LandingBatch& landings) const;
    void land_in_frame(FrameIndex f, std::uint32_t chosen, const RayBatch& rays, int count,
                       LandingBatch& landings) const;
    std::uint32_t blocked_between_frames(const RayBatch& segments, int count) const;
    void resolve_contact(LandingBatch& landings, int k, const RayPoint& direction) const;
    void resolve_edge(LandingBatch& landings, int k, const RayPoint& origin,
                      FrameIndex frame_of_origin, std::uint32_t triangle) const;
    void set_landing(LandingBatch& landings, int k, SurfaceIndex s, const RayPoint& at,
                     const RayPoint& direction) const;
    Triangle make_triangle(SurfaceIndex s, const Corners& corners) const;

    LocalTolerance tolerance_;
    std::vector<Vec3> origins_;  // of frames [m]
    double scale_ = 1.0;
    std::vector<float> lift_;
    std::vector<RayPoint> normals_;     // of surfaces
    std::vector<Triangle> triangles_;   // frame after frame
    std::vector<Corners> corners_;      // of triangles, in their frames; none if there is one frame
    std::vector<std::uint32_t> first_;  // triangle of each frame
    std::vector<std::vector<SurfaceIndex>> partners_;
    std::vector<Outline> outlines_;  // in ray space; empty where there are no partners
    std::unique_ptr<EmbreeScene> embree_;
};

}  // namespace patchlight
