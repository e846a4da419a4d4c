#pragma once

#include "solver/rays/ray_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace patchlight {

/// What Embree holds of a RayScene: of each frame the triangles that are at home there; where there
/// are several, each frame also sees the others, moved. For the files of RayScene alone, as it
/// brings Embree's header.
class EmbreeScene {
  public:
    explicit EmbreeScene(const std::string& instructions);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Triangles of the next frame, three indices each.
    void add_triangles(const std::vector<RayPoint>& vertices,
                       const std::vector<std::uint32_t>& indices);
    /// After the last frame: `shift` is what is added to a point of one frame to have it in
    /// another.
    void join(const std::function<Vec3(FrameIndex of, FrameIndex to)>& shift);

    /// All triangles, as frame f has them.
    RTCScene seen_from(FrameIndex f) const { return whole_[f]; }

  private:
    RTCScene new_scene() const;
    void check() const;

    RTCDevice device_ = nullptr;
    std::vector<RTCScene> own_, whole_;  // per frame; the same where there is one
    RTCError error_ = RTC_ERROR_NONE;
};

using RayLanes = std::array<int, ray_batch>;  // -1: in use, 0: not

/// The first `count` rays, or those of them that `chosen` has a bit of, from their origins to `end`
/// times their directions. The other lanes hold a ray of no length: where 16 rays are more than the
/// processor's width, Embree 3 goes by the lengths and not by `valid`.
template <typename Query>
void fill_query(const RayBatch& rays, int count, float end, Query& query, RayLanes& valid,
                std::uint32_t chosen = ~0u) {
    for (int k = 0; k < ray_batch; ++k) {
        const bool used = k < count && ((chosen >> k) & 1u);
        valid[k] = used ? -1 : 0;
        query.org_x[k] = used ? rays.ox[k] : 0.0f;
        query.org_y[k] = used ? rays.oy[k] : 0.0f;
        query.org_z[k] = used ? rays.oz[k] : 0.0f;
        query.dir_x[k] = used ? rays.dx[k] : 0.0f;
        query.dir_y[k] = used ? rays.dy[k] : 0.0f;
        query.dir_z[k] = used ? rays.dz[k] : 1.0f;
        query.tnear[k] = 0.0f;
        query.tfar[k] = used ? end : -std::numeric_limits<float>::infinity();
        query.time[k] = 0.0f;
        query.mask[k] = ~0u;
        query.id[k] = 0;
        query.flags[k] = 0;
    }
}

void intersect(RTCScene scene, const RayLanes& valid, RTCRayHit16& query);
void intersect(RTCScene scene, RTCRayHit& query);
void occlude(RTCScene scene, const RayLanes& valid, RTCRay16& query);

}  // namespace patchlight
