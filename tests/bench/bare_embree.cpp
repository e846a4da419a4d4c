#include "tests/bench/bare_embree.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>

namespace patchlight {

struct BareEmbree::Handles {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    ~Handles() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

BareEmbree::BareEmbree(const Scene& scene, const RayScene& ray_space)
    : handles_(std::make_unique<Handles>()) {
    std::vector<RayPoint> vertices;
    std::vector<std::uint32_t> indices;
    for (const Surface& surface : scene.surfaces) {
        const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
        std::vector<Vec2> flat;
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (const Vec3& p : surface.corners) {
            flat.push_back(frame.flat(p));
            vertices.push_back(ray_space.to_ray_space(p));
        }
        for (const auto& triangle : triangulate(flat))
            for (const std::uint32_t corner : triangle) indices.push_back(first + corner);
    }
    const RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT3, 12, vertices.size()));
    auto* i = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, indices.size() / 3));
    for (std::size_t k = 0; k < vertices.size(); ++k)
        for (int axis = 0; axis < 3; ++axis)
            v[3 * k + static_cast<std::size_t>(axis)] = vertices[k][axis];
    std::copy(indices.begin(), indices.end(), i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(handles_->scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(handles_->scene);
}

BareEmbree::~BareEmbree() = default;

std::uint64_t BareEmbree::one_by_one(const std::vector<RayBatch>& rays) const {
    std::uint64_t sum = 0;
    for (const RayBatch& batch : rays)
        for (int k = 0; k < ray_batch; ++k) {
            RTCRayHit query;
            query.ray = {batch.ox[k], batch.oy[k], batch.oz[k], 0.0f, batch.dx[k], batch.dy[k],
                         batch.dz[k], 0.0f,        16.0f,       ~0u,  0,           0};
            query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
            rtcIntersect1(handles_->scene, &query, nullptr);
#else
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            rtcIntersect1(handles_->scene, &context, &query);
#endif
            sum += query.hit.primID;
        }
    return sum;
}

std::uint64_t BareEmbree::in_packets(const std::vector<RayBatch>& rays) const {
    std::uint64_t sum = 0;
    alignas(64) std::array<int, ray_batch> valid;
    valid.fill(-1);
    for (const RayBatch& batch : rays) {
        RTCRayHit16 query;
        for (int k = 0; k < ray_batch; ++k) {
            query.ray.org_x[k] = batch.ox[k], query.ray.org_y[k] = batch.oy[k],
            query.ray.org_z[k] = batch.oz[k];
            query.ray.dir_x[k] = batch.dx[k], query.ray.dir_y[k] = batch.dy[k],
            query.ray.dir_z[k] = batch.dz[k];
            query.ray.tnear[k] = query.ray.time[k] = 0.0f;
            query.ray.tfar[k] = 16.0f;
            query.ray.mask[k] = ~0u;
            query.ray.flags[k] = query.ray.id[k] = 0;
            query.hit.geomID[k] = query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect16(valid.data(), handles_->scene, &query, nullptr);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect16(valid.data(), handles_->scene, &context, &query);
#endif
        for (int k = 0; k < ray_batch; ++k) sum += query.hit.primID[k];
    }
    return sum;
}

}  // namespace patchlight
