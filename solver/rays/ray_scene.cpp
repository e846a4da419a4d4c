#include "solver/rays/ray_scene.h"

#include "solver/rays/embree_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace patchlight {

namespace {

constexpr double lift_off_partner = 1.2;  // of the contact distance [1]
/// Steps of float: more than rounding moves the ends of rays and segments by, and fewer than the
/// four that surfaces at least are apart which are not in contact [1].
constexpr double lift_alone = 3.5;
/// Of a segment, from where on it is at its goal: where a ray meets a plane is known to some steps
/// of float of the whole way, and a goal's own surface is not to block it. Of 400 lamps of 5 cm in
/// a ceiling a tenth were dark to the point below their middle when this was 1.
constexpr float before_end = 1.0f - 0x1p-21f;
constexpr double float_step = 0x1p-23;
constexpr float inside_edge = 4.0f;  // contact distances: where a hit on an edge is looked at again
constexpr float largest_share = 0.05f;  // of a triangle's height, that counts as its edge

/// One over the radius of the smallest frame [1/m].
double scale_of(const std::vector<LocalFrame>& frames) {
    double least = std::numeric_limits<double>::infinity();
    for (const LocalFrame& frame : frames)
        if (frame.radius() > 0.0) least = std::min(least, frame.radius());
    return 1.0 / least;
}

}  // namespace

RayScene::RayScene(const Scene& scene, const CoplanarOverlaps& overlaps,
                   const std::string& instructions)
    : tolerance_(scene),
      scale_(scale_of(tolerance_.frames())),
      partners_(overlaps.partners),
      embree_(std::make_unique<EmbreeScene>(instructions)) {
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
        embree_->add_triangles(vertices, indices);
    }
    embree_->join([this](FrameIndex of, FrameIndex to) { return shift(of, to); });
}

void RayScene::land(const RayBatch& rays, int count, LandingBatch& landings) const {
    if (frames() > 1) {
        land_between_frames(rays, count, landings);
        return;
    }
    RTCRayHit16 query;
    alignas(64) RayLanes valid;
    fill_query(rays, count, std::numeric_limits<float>::infinity(), query.ray, valid);
    std::fill_n(query.hit.geomID, ray_batch, RTC_INVALID_GEOMETRY_ID);
    intersect(embree_->seen_from(0), valid, query);
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
    intersect(embree_->seen_from(frame_of_origin), query);
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
    alignas(64) RayLanes valid;
    fill_query(segments, count, before_end, query, valid);
    occlude(embree_->seen_from(0), valid, query);
    std::uint32_t bits = 0;
    for (int k = 0; k < count; ++k)
        if (query.tfar[k] < 0.0f) bits |= 1u << k;
    return bits;
}

}  // namespace patchlight
