#include "tests/solver/rays/cast.h"

namespace patchlight {

namespace {

RayBatch single(const RayPoint& origin, const RayPoint& direction, FrameIndex frame) {
    RayBatch batch{};
    batch.frame[0] = frame;
    batch.ox[0] = origin.x(), batch.oy[0] = origin.y(), batch.oz[0] = origin.z();
    batch.dx[0] = direction.x(), batch.dy[0] = direction.y(), batch.dz[0] = direction.z();
    return batch;
}

}  // namespace

Hit Caster::land(const Vec3& origin, const Vec3& direction) const {
    LandingBatch landings;
    const FrameIndex frame = rays.frame_at(origin);
    rays.land(single(rays.to_ray_space(origin, frame), direction.normalized().cast<float>(), frame),
              1, landings);
    if (landings.landing[0] == Landing::escaped) return {};
    return {landings.landing[0], landings.surface[0],
            RayPoint(landings.x[0], landings.y[0], landings.z[0])};  // in the surface's frame
}

bool Caster::blocked(const Vec3& from, const Vec3& to) const {
    const FrameIndex here = rays.frame_at(from), there = rays.frame_at(to);
    const RayPoint start = rays.to_ray_space(from, here), end = rays.to_ray_space(to, there);
    const RayPoint way = end + rays.shift(there, here).cast<float>() - start;
    RayBatch segment{};
    RayScene::set_segment(segment, 0, start, here, way, end, there);
    return rays.blocked(segment, 1) != 0;
}

}  // namespace patchlight
