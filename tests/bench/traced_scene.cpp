#include "tests/bench/traced_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace patchlight {

namespace {

constexpr double float_step = 0x1p-23;   // of a number [1]
constexpr double steps = 4.0;            // that make up a contact, and a ray's lift
constexpr double coincidence = 1e-6;     // of the smaller surface's size [1]
constexpr double parallel = 1.0 - 1e-9;  // cosine between normals of one plane [1]
constexpr float infinite = 1e30f;

double reach_of(const Surface& surface, const Vec3& centre) {
    double reach = 0.0;
    for (const Vec3& p : surface.corners)
        reach = std::max(reach, (p - centre).cwiseAbs().maxCoeff());
    return reach;
}

double size_of(const Surface& surface) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : surface.corners) box.extend(p);
    return box.diagonal().norm();
}

Vec3 middle_of(const Scene& scene) {
    Vec3 middle = Vec3::Zero();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        std::vector<double> places;
        for (const Surface& surface : scene.surfaces) places.push_back(surface.corners[0][axis]);
        if (places.empty()) return middle;
        const auto half = places.begin() + static_cast<std::ptrdiff_t>(places.size() / 2);
        std::nth_element(places.begin(), half, places.end());
        middle[axis] = *half;
    }
    return middle;
}

FlatPolygon flat_polygon(const Surface& surface) {
    FlatPolygon flat;
    flat.frame = frame_along(surface.corners, surface.normal);
    for (const Vec3& p : surface.corners) flat.corners.push_back(flat.frame.flat(p));
    flat.low = flat.high = flat.corners[0];
    for (const Vec2& p : flat.corners) {
        flat.low = flat.low.cwiseMin(p);
        flat.high = flat.high.cwiseMax(p);
    }
    double area = 0.0;
    for (const auto& [i, j, k] : triangulate(flat.corners)) {
        flat.triangles.push_back({flat.corners[i], flat.corners[j], flat.corners[k]});
        area += 0.5 * turn(flat.corners[i], flat.corners[j], flat.corners[k]);
        flat.cumulated_area.push_back(area);
    }
    return flat;
}

RTCRay ray_of(const Vec3& origin, const Vec3& direction, float from, float to) {
    const Eigen::Vector3f o = origin.cast<float>(), d = direction.cast<float>();
    return {o.x(), o.y(), o.z(), from, d.x(), d.y(), d.z(), 0.0f, to, ~0u, 0, 0};
}

}  // namespace

Vec2 FlatPolygon::draw(Random& random) const {
    const double at = random.unit() * cumulated_area.back();
    const auto found = std::upper_bound(cumulated_area.begin(), cumulated_area.end() - 1, at);
    const auto& [a, b, c] = triangles[static_cast<std::size_t>(found - cumulated_area.begin())];
    const double root = std::sqrt(random.unit()), v = random.unit();
    return (1.0 - root) * a + root * (1.0 - v) * b + root * v * c;
}

TracedScene::TracedScene(const Scene& scene)
    : scene_(scene),
      centre_(middle_of(scene)),
      is_second_half_(scene.surfaces.size()),
      coincident_(scene.surfaces.size()),
      covers_(scene.surfaces.size()) {
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s) {
        const Surface& surface = scene.surfaces[s];
        is_second_half_[s] = surface.side == Side::back;
        flat_.push_back(flat_polygon(surface));
        lift_.push_back(steps * float_step * reach_of(surface, centre_));
    }
    find_coincident();
    find_covers();
    build_triangles();
}

TracedScene::~TracedScene() {
    rtcReleaseScene(embree_);
    rtcReleaseDevice(device_);
}

/// Pairs whose boxes meet are found by a sweep along x.
void TracedScene::find_coincident() {
    std::vector<Eigen::AlignedBox3d> box(scene_.surfaces.size());
    std::vector<SurfaceIndex> order;
    for (SurfaceIndex s = 0; s < scene_.surfaces.size(); ++s) {
        if (is_second_half_[s]) continue;
        order.push_back(s);
        for (const Vec3& p : scene_.surfaces[s].corners) box[s].extend(p);
        box[s].min().array() -= lift_[s];
        box[s].max().array() += lift_[s];
    }
    std::sort(order.begin(), order.end(),
              [&](SurfaceIndex a, SurfaceIndex b) { return box[a].min().x() < box[b].min().x(); });
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1;
             j < order.size() && box[order[j]].min().x() <= box[order[i]].max().x(); ++j) {
            SurfaceIndex small = order[i], large = order[j];
            if (!box[small].intersects(box[large])) continue;
            if (size_of(scene_.surfaces[small]) > size_of(scene_.surfaces[large]))
                std::swap(small, large);
            const Surface &a = scene_.surfaces[small], &b = scene_.surfaces[large];
            if (std::abs(a.normal.dot(b.normal)) < parallel) continue;
            const double reach = std::max(coincidence * size_of(a), lift_[small]);
            const bool in_plane = std::all_of(
                a.corners.begin(), a.corners.end(),
                [&](const auto& p) { return std::abs((p - b.corners[0]).dot(b.normal)) <= reach; });
            if (!in_plane) continue;
            coincident_[small].push_back(large);
            coincident_[large].push_back(small);
        }
}

void TracedScene::find_covers() {
    for (SurfaceIndex s = 0; s < scene_.surfaces.size(); ++s)
        for (const SurfaceIndex other : coincident_[first_half(s)]) {
            const auto front = facing(other, -scene_.surfaces[s].normal);
            if (front && *front > s) covers_[s].push_back(*front);
        }
}

void TracedScene::build_triangles() {
    for (SurfaceIndex s = 0; s < scene_.surfaces.size(); ++s) {
        if (is_second_half_[s]) continue;
        for (const auto& [a, b, c] : flat_[s].triangles) {
            triangles_.push_back(
                {flat_[s].frame.lift(a), flat_[s].frame.lift(b), flat_[s].frame.lift(c)});
            surface_of_.push_back(s);
        }
    }
    device_ = rtcNewDevice(nullptr);
    embree_ = rtcNewScene(device_);
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * triangles_.size()));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, triangles_.size()));
    for (std::size_t k = 0; k < 3 * triangles_.size(); ++k) {
        const Eigen::Vector3f p = (triangles_[k / 3][k % 3] - centre_).cast<float>();
        std::copy_n(p.data(), 3, v + 3 * k);
        index[k] = static_cast<unsigned>(k);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_, geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneFlags(embree_, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(embree_);
}

Vec3 TracedScene::lifted(SurfaceIndex s, const Vec3& position) const {
    return position - centre_ + lift_[s] * scene_.surfaces[s].normal;
}

std::optional<SurfaceIndex> TracedScene::facing(SurfaceIndex first, const Vec3& direction) const {
    const Surface& surface = scene_.surfaces[first];
    if (surface.normal.dot(direction) < 0.0) return first;
    if (first + 1 < scene_.surfaces.size() && is_second_half_[first + 1]) return first + 1;
    return std::nullopt;
}

std::optional<LandedAt> TracedScene::land(SurfaceIndex from, const Vec3& position,
                                          const Vec3& direction) const {
    const Vec3 origin = lifted(from, position);
    float begin = 0.0f;
    for (;;) {
        RTCRayHit query{};
        query.ray = ray_of(origin, direction, begin, infinite);
        query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
        rtcIntersect1(embree_, &query, nullptr);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(embree_, &context, &query);
#endif
        if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        const SurfaceIndex hit = surface_of_[query.hit.primID];
        if (hit == first_half(from)) {  // a plane does not see itself: rounding
            begin = std::nextafter(query.ray.tfar, infinite) * (1.0f + 0x1p-20f);
            continue;
        }
        const auto& [a, b, c] = triangles_[query.hit.primID];
        const double u = query.hit.u, v = query.hit.v;
        LandedAt at{hit, (1.0 - u - v) * a + u * b + v * c};
        std::optional<SurfaceIndex> best = facing(hit, direction);
        for (const SurfaceIndex other : coincident_[hit]) {
            const auto front = facing(other, direction);
            if (!front || (best && *front < *best)) continue;
            if (contains(flat_[other].corners, flat_[other].frame.flat(at.position))) best = front;
        }
        if (!best) return std::nullopt;
        at.surface = *best;
        return at;
    }
}

bool TracedScene::sees(SurfaceIndex from, const Vec3& a, SurfaceIndex to, const Vec3& b) const {
    const Vec3 start = lifted(from, a), end = lifted(to, b);
    RTCRay query = ray_of(start, end - start, 0.0f, 1.0f);
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(embree_, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree_, &context, &query);
#endif
    return query.tfar >= 0.0f;
}

bool TracedScene::is_covered(SurfaceIndex s, const Vec3& position) const {
    return std::any_of(covers_[s].begin(), covers_[s].end(), [&](SurfaceIndex cover) {
        return contains(flat_[cover].corners, flat_[cover].frame.flat(position));
    });
}

}  // namespace patchlight
