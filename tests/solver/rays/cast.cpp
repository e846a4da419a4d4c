#include "tests/solver/rays/cast.h"

namespace patchlight {

namespace {

RayBatch single(const RayPoint& origin, const RayPoint& direction) {
    RayBatch batch{};
    batch.ox[0] = origin.x(), batch.oy[0] = origin.y(), batch.oz[0] = origin.z();
    batch.dx[0] = direction.x(), batch.dy[0] = direction.y(), batch.dz[0] = direction.z();
    return batch;
}

}  // namespace

Hit Caster::land(const Vec3& origin, const Vec3& direction) const {
    LandingBatch landings;
    rays.land(single(rays.to_ray_space(origin), direction.normalized().cast<float>()), 1, landings);
    if (landings.landing[0] == Landing::escaped) return {};
    return {landings.landing[0], landings.surface[0],
            RayPoint(landings.x[0], landings.y[0], landings.z[0])};
}

bool Caster::blocked(const Vec3& from, const Vec3& to) const {
    const RayPoint start = rays.to_ray_space(from), end = rays.to_ray_space(to);
    return rays.blocked(single(start, end - start), 1) != 0;
}

}  // namespace patchlight
