#include "solver/rays/embree_scene.h"

#include <algorithm>
#include <bit>

namespace patchlight {

namespace {

std::uint32_t lanes_of(FrameIndex f, const std::array<FrameIndex, ray_batch>& frames) {
    std::uint32_t lanes = 0;
    for (std::size_t k = 0; k < frames.size(); ++k)
        if (frames[k] == f) lanes |= 1u << k;
    return lanes;
}

}  // namespace

void RayScene::land_between_frames(const RayBatch& rays, int count, LandingBatch& landings) const {
    std::uint32_t left = (1u << count) - 1u;
    while (left != 0) {
        const FrameIndex f = rays.frame[static_cast<std::size_t>(std::countr_zero(left))];
        const std::uint32_t chosen = left & lanes_of(f, rays.frame);
        land_in_frame(f, chosen, rays, count, landings);
        left &= ~chosen;
    }
}

/// Where they land follows from the place on the triangle that is hit, in its own frame: from the
/// length of the ray it would be known no better than that.
void RayScene::land_in_frame(FrameIndex f, std::uint32_t chosen, const RayBatch& rays, int count,
                             LandingBatch& landings) const {
    RTCRayHit16 query;
    alignas(64) RayLanes valid;
    fill_query(rays, count, std::numeric_limits<float>::infinity(), query.ray, valid, chosen);
    std::fill_n(query.hit.geomID, ray_batch, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], ray_batch, RTC_INVALID_GEOMETRY_ID);
    intersect(embree_->seen_from(f), valid, query);
    for (int k = 0; k < count; ++k) {
        if (!((chosen >> k) & 1u)) continue;
        if (query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) {
            landings.landing[k] = Landing::escaped;
            continue;
        }
        const std::uint32_t triangle = first_[query.hit.instID[0][k]] + query.hit.primID[k];
        const RayPoint origin(rays.ox[k], rays.oy[k], rays.oz[k]),
            direction(rays.dx[k], rays.dy[k], rays.dz[k]);
        const float u = query.hit.u[k], v = query.hit.v[k];
        const auto& [a, b, c] = corners_[triangle];
        set_landing(landings, k, triangles_[triangle].surface, a + u * (b - a) + v * (c - a),
                    direction);
        if (std::min({u, v, 1.0f - u - v}) < triangles_[triangle].edge_share)
            resolve_edge(landings, k, origin, f, triangle);
    }
}

std::uint32_t RayScene::blocked_between_frames(const RayBatch& segments, int count) const {
    std::uint32_t bits = 0, across = 0;
    RayBatch back;
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
        if (segments.frame[k] == segments.end_frame[k]) continue;
        across |= 1u << k;
        back.ox[k] = segments.ex[k], back.oy[k] = segments.ey[k], back.oz[k] = segments.ez[k];
        back.dx[k] = -segments.dx[k], back.dy[k] = -segments.dy[k], back.dz[k] = -segments.dz[k];
    }
    const auto trace = [&](const RayBatch& rays, const std::array<FrameIndex, ray_batch>& frames_of,
                           std::uint32_t lanes, float end) {
        while (lanes != 0) {
            const FrameIndex f = frames_of[static_cast<std::size_t>(std::countr_zero(lanes))];
            const std::uint32_t chosen = lanes & lanes_of(f, frames_of);
            RTCRay16 query;
            alignas(64) RayLanes valid;
            fill_query(rays, count, end, query, valid, chosen);
            occlude(embree_->seen_from(f), valid, query);
            for (int k = 0; k < count; ++k)
                if (((chosen >> k) & 1u) && query.tfar[k] < 0.0f) bits |= 1u << k;
            lanes &= ~chosen;
        }
    };
    trace(segments, segments.frame, ((1u << count) - 1u) & ~across, 1.0f);
    trace(segments, segments.frame, across, 0.5f);
    trace(back, segments.end_frame, across & ~bits, 0.5f);
    return bits;
}

}  // namespace patchlight
