#include "solver/rays/ray_scene.h"

#include <Eigen/Geometry>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>

namespace patchlight {

namespace {

constexpr double lift_alone = 0.3;  // of the contact distance; floats in ray space step by 6e-8 [1]
constexpr double lift_off_partner = 1.2;  // of the contact distance [1]
constexpr float inside_edge = 4.0f;  // contact distances: where a hit on an edge is looked at again
constexpr float largest_share = 0.05f;      // of a triangle's height, that counts as its edge
constexpr float beyond_everything = 16.0f;  // ray space is 2 across

}  // namespace

struct RayScene::Device {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    explicit Device(const std::string& instructions) {
        std::string config = "threads=0,set_affinity=0";
        if (!instructions.empty()) config += ",isa=" + instructions;
        device = rtcNewDevice(config.c_str());
        if (!device) throw std::bad_alloc();
        rtcSetDeviceErrorFunction(device, &on_error, this);
        scene = rtcNewScene(device);
        if (!scene) throw std::bad_alloc();
    }
    ~Device() {
        if (scene) rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    static void on_error(void* self, RTCError code, const char*) {
        static_cast<Device*>(self)->error = code;
    }
    RTCError error = RTC_ERROR_NONE;
};

RayScene::RayScene(const Scene& scene, const CoplanarOverlaps& overlaps,
                   const std::string& instructions)
    : partners_(overlaps.partners), device_(std::make_unique<Device>(instructions)) {
    Eigen::AlignedBox3d box;
    for (const Surface& surface : scene.surfaces)
        for (const Vec3& p : surface.corners) box.extend(p);
    centre_ = box.center();
    scale_ = 2.0 / box.sizes().maxCoeff();
    contact_ = static_cast<float>(contact_distance(scene) * scale_);
    find_lifts(scene, overlaps);
    build(scene);
}

RayScene::~RayScene() = default;

void RayScene::find_lifts(const Scene& scene, const CoplanarOverlaps& overlaps) {
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const bool alone = !overlaps.any(s);
        lift_.push_back(static_cast<float>(contact_ * (alone ? lift_alone : lift_off_partner)));
        normals_.push_back(scene.surfaces[s].normal.cast<float>());
        outlines_.emplace_back();
        if (alone) continue;
        Outline& outline = outlines_.back();
        outline.frame =
            frame_of((scene.surfaces[s].corners[0] - centre_) * scale_, scene.surfaces[s].normal);
        for (const Vec3& p : scene.surfaces[s].corners)
            outline.corners.push_back(outline.frame.flat((p - centre_) * scale_));
    }
}

RayScene::Triangle RayScene::make_triangle(SurfaceIndex s, const RayPoint& a, const RayPoint& b,
                                           const RayPoint& c) const {
    const float twice_area = (b - a).cross(c - a).norm();
    const float longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const float height = twice_area / longest;  // the smallest of the three
    return {s, (a + b + c) / 3.0f,
            height > 0.0f ? std::min(largest_share, contact_ / height) : largest_share};
}

void RayScene::build(const Scene& scene) {
    std::vector<RayPoint> vertices;
    std::vector<std::uint32_t> indices;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
        std::vector<Vec2> flat;
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (const Vec3& p : surface.corners) {
            flat.push_back(frame.flat(p));
            vertices.push_back(to_ray_space(p));
        }
        for (const auto& triangle : triangulate(flat)) {
            for (const std::uint32_t corner : triangle) indices.push_back(first + corner);
            triangles_.push_back(make_triangle(s, vertices[first + triangle[0]],
                                               vertices[first + triangle[1]],
                                               vertices[first + triangle[2]]));
        }
    }
    const RTCGeometry geometry = rtcNewGeometry(device_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex_buffer = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), vertices.size()));
    auto* index_buffer = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), triangles_.size()));
    if (!vertex_buffer || !index_buffer) throw std::bad_alloc();
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
            vertex_buffer[3 * v + static_cast<std::size_t>(axis)] = vertices[v][axis];
    std::copy(indices.begin(), indices.end(), index_buffer);
    rtcSetGeometryMask(geometry, ~0u);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(device_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(device_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(device_->scene, RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(device_->scene);
    if (device_->error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (device_->error != RTC_ERROR_NONE)
        throw std::runtime_error("Embree could not build the scene: error " +
                                 std::to_string(device_->error));
}

namespace {

/// The first `count` rays, from their origins to `end` times their directions. The other lanes hold
/// a ray of no length: where 16 rays are more than the processor's width, Embree 3 goes by the
/// lengths and not by `valid`.
template <typename Query>
void fill_query(const RayBatch& rays, int count, float end, Query& query,
                std::array<int, ray_batch>& valid) {
    for (int k = 0; k < ray_batch; ++k) {
        const bool used = k < count;
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

}  // namespace

void RayScene::land(const RayBatch& rays, int count, LandingBatch& landings) const {
    RTCRayHit16 query;
    alignas(64) std::array<int, ray_batch> valid;
    fill_query(rays, count, beyond_everything, query.ray, valid);
    std::fill_n(query.hit.geomID, ray_batch, RTC_INVALID_GEOMETRY_ID);
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid.data(), device_->scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid.data(), device_->scene, &context, &query);
#endif
    for (int k = 0; k < count; ++k) {
        if (query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) {
            landings.landing[k] = Landing::escaped;
            continue;
        }
        const std::uint32_t triangle = query.hit.primID[k];
        const RayPoint origin(rays.ox[k], rays.oy[k], rays.oz[k]),
            direction(rays.dx[k], rays.dy[k], rays.dz[k]);
        set_landing(landings, k, triangles_[triangle].surface,
                    origin + query.ray.tfar[k] * direction, direction);
        const float u = query.hit.u[k], v = query.hit.v[k];
        if (std::min({u, v, 1.0f - u - v}) < triangles_[triangle].edge_share)
            resolve_edge(landings, k, origin, triangle);
    }
}

void RayScene::set_landing(LandingBatch& landings, int k, SurfaceIndex s, const RayPoint& at,
                           const RayPoint& direction) const {
    landings.surface[k] = s;
    landings.x[k] = at.x();
    landings.y[k] = at.y();
    landings.z[k] = at.z();
    landings.landing[k] = normals_[s].dot(direction) < 0.0f ? Landing::front : Landing::back;
    if (!partners_[s].empty()) resolve_contact(landings, k, direction);
}

void RayScene::resolve_edge(LandingBatch& landings, int k, const RayPoint& origin,
                            std::uint32_t triangle) const {
    const SurfaceIndex s = triangles_[triangle].surface;
    const RayPoint at(landings.x[k], landings.y[k], landings.z[k]);
    const RayPoint inward = triangles_[triangle].centre - at;
    const float step = std::min(1.0f, inside_edge * contact_ / inward.norm());
    const float side = normals_[s].dot(origin - at) > 0.0f ? 1.0f : -1.0f;
    const RayPoint direction = at + step * inward + side * lift_[s] * normals_[s] - origin;
    RTCRayHit query{};
    query.ray.org_x = origin.x(), query.ray.org_y = origin.y(), query.ray.org_z = origin.z();
    query.ray.dir_x = direction.x(), query.ray.dir_y = direction.y(),
    query.ray.dir_z = direction.z();
    query.ray.tfar = 1.0f;
    query.ray.mask = ~0u;
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(device_->scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(device_->scene, &context, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    set_landing(landings, k, triangles_[query.hit.primID].surface,
                origin + query.ray.tfar * direction, direction);
}

void RayScene::resolve_contact(LandingBatch& landings, int k, const RayPoint& direction) const {
    const SurfaceIndex hit = landings.surface[k];
    const Vec3 p(landings.x[k], landings.y[k], landings.z[k]);
    bool found = landings.landing[k] == Landing::front;
    for (const SurfaceIndex s : partners_[hit]) {  // ascending: the last one wins
        if (normals_[s].dot(direction) >= 0.0f || (found && s < landings.surface[k])) continue;
        if (!contains(outlines_[s].corners, outlines_[s].frame.flat(p))) continue;
        landings.surface[k] = s;
        landings.landing[k] = Landing::front;
        found = true;
    }
}

std::uint32_t RayScene::blocked(const RayBatch& segments, int count) const {
    RTCRay16 query;
    alignas(64) std::array<int, ray_batch> valid;
    fill_query(segments, count, 1.0f, query, valid);
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded16(valid.data(), device_->scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid.data(), device_->scene, &context, &query);
#endif
    std::uint32_t bits = 0;
    for (int k = 0; k < count; ++k)
        if (query.tfar[k] < 0.0f) bits |= 1u << k;
    return bits;
}

}  // namespace patchlight
