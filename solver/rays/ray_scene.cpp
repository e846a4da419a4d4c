#include "solver/rays/ray_scene.h"

#include <Eigen/Geometry>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <string>

namespace patchlight {

namespace {

constexpr double lift_off_partner = 1.2;  // of the contact distance [1]
/// Steps of float: more than rounding moves the ends of rays and segments by, and fewer than the
/// four that surfaces at least are apart which are not in contact [1].
constexpr double lift_alone = 3.5;
constexpr double float_step = 0x1p-23;
constexpr float inside_edge = 4.0f;  // contact distances: where a hit on an edge is looked at again
constexpr float largest_share = 0.05f;      // of a triangle's height, that counts as its edge
constexpr float beyond_everything = 16.0f;  // ray space is 2 across where there is one frame

/// One over the radius of the smallest frame [1/m].
double scale_of(const std::vector<LocalFrame>& frames) {
    double least = std::numeric_limits<double>::infinity();
    for (const LocalFrame& frame : frames)
        if (frame.radius() > 0.0) least = std::min(least, frame.radius());
    return 1.0 / least;
}

}  // namespace

/// Of each frame the triangles that are at home there; where there are several, each also sees the
/// others, moved.
struct RayScene::Device {
    RTCDevice device = nullptr;
    std::vector<RTCScene> own, whole;  // per frame; the same where there is one
    explicit Device(const std::string& instructions) {
        std::string config = "threads=0,set_affinity=0";
        if (!instructions.empty()) config += ",isa=" + instructions;
        device = rtcNewDevice(config.c_str());
        if (!device) throw std::bad_alloc();
        rtcSetDeviceErrorFunction(device, &on_error, this);
    }
    ~Device() {
        for (const RTCScene scene : own) rtcReleaseScene(scene);
        if (whole != own)
            for (const RTCScene scene : whole) rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    RTCScene new_scene() const {
        const RTCScene scene = rtcNewScene(device);
        if (!scene) throw std::bad_alloc();
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
        return scene;
    }
    void add_triangles(const std::vector<RayPoint>& vertices,
                       const std::vector<std::uint32_t>& indices);
    void join(const RayScene& rays);
    void check() const {
        if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        if (error != RTC_ERROR_NONE)
            throw std::runtime_error("Embree could not build the scene: error " +
                                     std::to_string(error));
    }
    static void on_error(void* self, RTCError code, const char*) {
        static_cast<Device*>(self)->error = code;
    }
    RTCError error = RTC_ERROR_NONE;
};

/// Own scene of the next frame.
void RayScene::Device::add_triangles(const std::vector<RayPoint>& vertices,
                                     const std::vector<std::uint32_t>& indices) {
    own.push_back(new_scene());
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex_buffer = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), vertices.size()));
    auto* index_buffer = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), indices.size() / 3));
    if (!vertices.empty() && (!vertex_buffer || !index_buffer)) throw std::bad_alloc();
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
            vertex_buffer[3 * v + static_cast<std::size_t>(axis)] = vertices[v][axis];
    std::copy(indices.begin(), indices.end(), index_buffer);
    rtcSetGeometryMask(geometry, ~0u);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(own.back(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(own.back());
    check();
}

void RayScene::Device::join(const RayScene& rays) {
    if (own.size() == 1) {
        whole = own;
        return;
    }
    for (std::size_t to = 0; to < own.size(); ++to) {
        whole.push_back(new_scene());
        for (std::size_t of = 0; of < own.size(); ++of) {
            const Eigen::Vector3f shift =
                rays.shift(static_cast<FrameIndex>(of), static_cast<FrameIndex>(to)).cast<float>();
            const std::array<float, 12> transform{1, 0, 0, 0,         1,         0,
                                                  0, 0, 1, shift.x(), shift.y(), shift.z()};
            const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(instance, own[of]);
            rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                                    transform.data());
            rtcSetGeometryMask(instance, ~0u);
            rtcCommitGeometry(instance);
            rtcAttachGeometryByID(whole.back(), instance, static_cast<unsigned>(of));
            rtcReleaseGeometry(instance);
        }
        rtcCommitScene(whole.back());
    }
    check();
}

RayScene::RayScene(const Scene& scene, const CoplanarOverlaps& overlaps,
                   const std::string& instructions)
    : tolerance_(scene),
      scale_(scale_of(tolerance_.frames())),
      partners_(overlaps.partners),
      device_(std::make_unique<Device>(instructions)) {
    for (const LocalFrame& frame : tolerance_.frames()) origins_.push_back(frame.origin());
    find_lifts(scene, overlaps);
    build(scene);
}

RayScene::~RayScene() = default;

float RayScene::contact_at(const Vec3& p, FrameIndex f) const {
    const double steps = 4.0 * float_step * (p - origins_[f]).cwiseAbs().maxCoeff() * scale_;
    return std::max(contact(f), static_cast<float>(steps));
}

void RayScene::find_lifts(const Scene& scene, const CoplanarOverlaps& overlaps) {
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const bool alone = !overlaps.any(s);
        double lift = lift_alone * tolerance_.step(s);
        for (const SurfaceIndex partner : partners_[s])
            lift = std::max(lift, lift_off_partner * tolerance_.between(s, partner));
        lift_.push_back(static_cast<float>(lift * scale_));
        normals_.push_back(scene.surfaces[s].normal.cast<float>());
        outlines_.emplace_back();
        if (alone) continue;
        Outline& outline = outlines_.back();
        const Vec3 origin = origins_[frame(s)];
        outline.frame =
            frame_of((scene.surfaces[s].corners[0] - origin) * scale_, scene.surfaces[s].normal);
        for (const Vec3& p : scene.surfaces[s].corners)
            outline.corners.push_back(outline.frame.flat((p - origin) * scale_));
    }
}

RayScene::Triangle RayScene::make_triangle(SurfaceIndex s, const Corners& corners) const {
    const auto& [a, b, c] = corners;
    const float twice_area = (b - a).cross(c - a).norm();
    const float longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const float height = twice_area / longest;  // the smallest of the three
    return {s, (a + b + c) / 3.0f,
            height > 0.0f ? std::min(largest_share, contact(frame(s)) / height) : largest_share};
}

void RayScene::build(const Scene& scene) {
    for (std::size_t f = 0; f < frames(); ++f) {
        std::vector<RayPoint> vertices;
        std::vector<std::uint32_t> indices;
        first_.push_back(static_cast<std::uint32_t>(triangles_.size()));
        for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
            if (frame(s) != f) continue;
            const Surface& surface = scene.surfaces[s];
            const PlaneFrame plane = frame_of(surface.corners[0], surface.normal);
            std::vector<Vec2> flat;
            const auto first = static_cast<std::uint32_t>(vertices.size());
            for (const Vec3& p : surface.corners) {
                flat.push_back(plane.flat(p));
                vertices.push_back(to_ray_space(p, frame(s)));
            }
            for (const auto& triangle : triangulate(flat)) {
                for (const std::uint32_t corner : triangle) indices.push_back(first + corner);
                const Corners corners{vertices[first + triangle[0]], vertices[first + triangle[1]],
                                      vertices[first + triangle[2]]};
                triangles_.push_back(make_triangle(s, corners));
                if (frames() > 1) corners_.push_back(corners);
            }
        }
        device_->add_triangles(vertices, indices);
    }
    device_->join(*this);
}

namespace {

/// The first `count` rays, or those of them that `chosen` has a bit of, from their origins to `end`
/// times their directions. The other lanes hold a ray of no length: where 16 rays are more than the
/// processor's width, Embree 3 goes by the lengths and not by `valid`.
template <typename Query>
void fill_query(const RayBatch& rays, int count, float end, Query& query,
                std::array<int, ray_batch>& valid, std::uint32_t chosen = ~0u) {
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

void intersect(RTCScene scene, const std::array<int, ray_batch>& valid, RTCRayHit16& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid.data(), scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect16(valid.data(), scene, &context, &query);
#endif
}

void occlude(RTCScene scene, const std::array<int, ray_batch>& valid, RTCRay16& query) {
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded16(valid.data(), scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded16(valid.data(), scene, &context, &query);
#endif
}

std::uint32_t lanes_of(FrameIndex f, const std::array<FrameIndex, ray_batch>& frames) {
    std::uint32_t lanes = 0;
    for (std::size_t k = 0; k < frames.size(); ++k)
        if (frames[k] == f) lanes |= 1u << k;
    return lanes;
}

}  // namespace

void RayScene::land(const RayBatch& rays, int count, LandingBatch& landings) const {
    if (frames() > 1) {
        std::uint32_t left = (count < 32 ? 1u << count : 0u) - 1u;
        while (left != 0) {
            const FrameIndex f = rays.frame[static_cast<std::size_t>(std::countr_zero(left))];
            const std::uint32_t chosen = left & lanes_of(f, rays.frame);
            land_in_frame(f, chosen, rays, count, landings);
            left &= ~chosen;
        }
        return;
    }
    RTCRayHit16 query;
    alignas(64) std::array<int, ray_batch> valid;
    fill_query(rays, count, beyond_everything, query.ray, valid);
    std::fill_n(query.hit.geomID, ray_batch, RTC_INVALID_GEOMETRY_ID);
    intersect(device_->whole[0], valid, query);
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
            resolve_edge(landings, k, origin, 0, triangle);
    }
}

/// Where they land follows from the place on the triangle that is hit, in its own frame: from the
/// length of the ray it would be known no better than that.
void RayScene::land_in_frame(FrameIndex f, std::uint32_t chosen, const RayBatch& rays, int count,
                             LandingBatch& landings) const {
    RTCRayHit16 query;
    alignas(64) std::array<int, ray_batch> valid;
    fill_query(rays, count, std::numeric_limits<float>::infinity(), query.ray, valid, chosen);
    std::fill_n(query.hit.geomID, ray_batch, RTC_INVALID_GEOMETRY_ID);
    std::fill_n(query.hit.instID[0], ray_batch, RTC_INVALID_GEOMETRY_ID);
    intersect(device_->whole[f], valid, query);
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
                            FrameIndex frame_of_origin, std::uint32_t triangle) const {
    const SurfaceIndex s = triangles_[triangle].surface;
    const RayPoint at(landings.x[k], landings.y[k], landings.z[k]);
    const RayPoint from =
        frames() == 1 ? origin : RayPoint(origin + shift(frame_of_origin, frame(s)).cast<float>());
    const RayPoint inward = triangles_[triangle].centre - at;
    const float step = std::min(1.0f, inside_edge * contact(frame(s)) / inward.norm());
    const float side = normals_[s].dot(from - at) > 0.0f ? 1.0f : -1.0f;
    const RayPoint direction = at + step * inward + side * lift_[s] * normals_[s] - from;
    RTCRayHit query{};
    query.ray.org_x = origin.x(), query.ray.org_y = origin.y(), query.ray.org_z = origin.z();
    query.ray.dir_x = direction.x(), query.ray.dir_y = direction.y(),
    query.ray.dir_z = direction.z();
    query.ray.tfar = 1.0f;
    query.ray.mask = ~0u;
    query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(device_->whole[frame_of_origin], &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(device_->whole[frame_of_origin], &context, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    if (frames() == 1) {
        set_landing(landings, k, triangles_[query.hit.primID].surface,
                    origin + query.ray.tfar * direction, direction);
        return;
    }
    const std::uint32_t found = first_[query.hit.instID[0]] + query.hit.primID;
    const auto& [a, b, c] = corners_[found];
    set_landing(landings, k, triangles_[found].surface,
                a + query.hit.u * (b - a) + query.hit.v * (c - a), direction);
}

void RayScene::resolve_contact(LandingBatch& landings, int k, const RayPoint& direction) const {
    const SurfaceIndex hit = landings.surface[k];
    const Vec3 at(landings.x[k], landings.y[k], landings.z[k]);
    bool found = landings.landing[k] == Landing::front;
    for (const SurfaceIndex s : partners_[hit]) {  // ascending: the last one wins
        if (normals_[s].dot(direction) >= 0.0f || (found && s < landings.surface[k])) continue;
        const Vec3 p = frame(s) == frame(hit) ? at : Vec3(at + shift(frame(hit), frame(s)));
        if (!contains(outlines_[s].corners, outlines_[s].frame.flat(p))) continue;
        landings.surface[k] = s;
        landings.landing[k] = Landing::front;
        landings.x[k] = static_cast<float>(p.x());
        landings.y[k] = static_cast<float>(p.y());
        landings.z[k] = static_cast<float>(p.z());
        found = true;
    }
}

std::uint32_t RayScene::blocked(const RayBatch& segments, int count) const {
    if (frames() > 1) return blocked_between_frames(segments, count);
    RTCRay16 query;
    alignas(64) std::array<int, ray_batch> valid;
    fill_query(segments, count, 1.0f, query, valid);
    occlude(device_->whole[0], valid, query);
    std::uint32_t bits = 0;
    for (int k = 0; k < count; ++k)
        if (query.tfar[k] < 0.0f) bits |= 1u << k;
    return bits;
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
            alignas(64) std::array<int, ray_batch> valid;
            fill_query(rays, count, end, query, valid, chosen);
            occlude(device_->whole[f], valid, query);
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
