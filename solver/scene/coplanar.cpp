#include "solver/scene/coplanar.h"

#include "solver/scene/touching_pairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace patchlight {

namespace {

constexpr double least_overlap = 1e-7;  // of the smaller area [1]

/// Area of the part of triangle t that lies in triangle s and within `reach` of its plane.
double overlap_area(const std::array<Vec3, 3>& s, const std::array<Vec3, 3>& t, double reach) {
    const Vec3 normal = vector_area(s).normalized();
    const PlaneFrame frame = frame_of(s[0], normal);
    std::vector<Vec2> part;
    for (const Vec3& p : t) part.push_back(frame.flat(p));
    if (turn(part[0], part[1], part[2]) < 0.0) std::reverse(part.begin(), part.end());
    for (int k = 0; k < 3 && !part.empty(); ++k)
        part = clip_left(part, frame.flat(s[k]), frame.flat(s[(k + 1) % 3]));
    if (part.size() < 3) return 0.0;
    const Vec3 t_normal = vector_area(t).normalized();
    const double slope = t_normal.dot(normal);
    double area = 0.0;
    for (std::size_t k = 0; k < part.size(); ++k) {
        if (k + 1 < part.size()) area += 0.5 * turn(part[0], part[k], part[k + 1]);
        const double height = (t[0] - frame.lift(part[k])).dot(t_normal) / slope;
        if (std::abs(height) > reach) return 0.0;
    }
    return area;
}

using Triangles = std::vector<std::array<Vec3, 3>>;

Triangles triangles_of(const Surface& surface) {
    const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
    std::vector<Vec2> flat;
    for (const Vec3& p : surface.corners) flat.push_back(frame.flat(p));
    Triangles triangles;
    for (const auto& t : triangulate(flat))
        triangles.push_back({surface.corners[t[0]], surface.corners[t[1]], surface.corners[t[2]]});
    return triangles;
}

/// Not where they are far apart along the normal even at their nearest corners.
bool may_overlap(const Surface& a, const Surface& b, double reach) {
    if (std::abs(a.normal.dot(b.normal)) < 0.99) return false;
    double nearest = std::numeric_limits<double>::infinity();
    double lowest = nearest, highest = -nearest;
    for (const Vec3& p : b.corners) {
        const double height = (p - a.corners[0]).dot(a.normal);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    return lowest <= reach && highest >= -reach;
}

bool overlap(const Surface& a, const Surface& b, const Triangles& triangles_a,
             const Triangles& triangles_b, double reach) {
    const double enough = least_overlap * std::min(a.area, b.area);
    double area = 0.0;
    for (const auto& s : triangles_a)
        for (const auto& t : triangles_b) {
            area += overlap_area(s, t, reach);
            if (area > enough) return true;
        }
    return false;
}

}  // namespace

std::vector<Vec2> clip_left(const std::vector<Vec2>& polygon, const Vec2& a, const Vec2& b) {
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double at_p = turn(a, b, p), at_q = turn(a, b, q);
        if (at_p >= 0.0) kept.push_back(p);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
            kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    return kept;
}

CoplanarOverlaps find_coplanar_overlaps(const Scene& scene, const std::function<bool()>& go_on) {
    const std::size_t n = scene.surfaces.size();
    const LocalTolerance tolerance(scene);
    std::vector<Triangles> known(n);  // of surfaces that were looked at
    std::vector<std::once_flag> is_known(n);
    const auto triangles = [&](SurfaceIndex s) -> const Triangles& {
        std::call_once(is_known[s], [&] { known[s] = triangles_of(scene.surfaces[s]); });
        return known[s];
    };
    std::vector<std::vector<SurfaceIndex>> later(n);  // that overlap
    for_each_touching_pair(scene, tolerance, go_on, [&](SurfaceIndex a, SurfaceIndex b) {
        const double reach = tolerance.between(a, b);
        if (may_overlap(scene.surfaces[a], scene.surfaces[b], reach) &&
            overlap(scene.surfaces[a], scene.surfaces[b], triangles(a), triangles(b), reach))
            later[a].push_back(b);
    });
    CoplanarOverlaps overlaps{std::vector<std::vector<SurfaceIndex>>(n),
                              std::vector<std::vector<SurfaceIndex>>(n)};
    for (SurfaceIndex a = 0; a < n; ++a)
        for (const SurfaceIndex b : later[a]) {
            overlaps.partners[a].push_back(b);
            overlaps.partners[b].push_back(a);
            if (scene.surfaces[a].normal.dot(scene.surfaces[b].normal) > 0.0)
                overlaps.covered_by[a].push_back(b);
        }
    for (auto& partners : overlaps.partners) std::sort(partners.begin(), partners.end());
    for (auto& covers : overlaps.covered_by) std::sort(covers.begin(), covers.end());
    return overlaps;
}

}  // namespace patchlight
