#include "solver/scene/coplanar.h"

#include "solver/scene/finding_words.h"
#include "solver/scene/touching_pairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
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

std::vector<std::array<Vec3, 3>> triangles_of(const Surface& surface) {
    const PlaneFrame frame = frame_of(surface.corners[0], surface.normal);
    std::vector<Vec2> flat;
    for (const Vec3& p : surface.corners) flat.push_back(frame.flat(p));
    std::vector<std::array<Vec3, 3>> triangles;
    for (const auto& t : triangulate(flat))
        triangles.push_back({surface.corners[t[0]], surface.corners[t[1]], surface.corners[t[2]]});
    return triangles;
}

bool overlap(const Surface& a, const Surface& b, double reach) {
    if (std::abs(a.normal.dot(b.normal)) < 0.99) return false;
    // Far apart along the normal even at their nearest corners: not in one plane.
    double nearest = std::numeric_limits<double>::infinity();
    double lowest = nearest, highest = -nearest;
    for (const Vec3& p : b.corners) {
        const double height = (p - a.corners[0]).dot(a.normal);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    if (lowest > reach || highest < -reach) return false;
    double area = 0.0;
    const auto triangles_b = triangles_of(b);
    for (const auto& s : triangles_of(a))
        for (const auto& t : triangles_b) area += overlap_area(s, t, reach);
    return area > least_overlap * std::min(a.area, b.area);
}

Finding overlap_finding(const Scene& scene, const Surface& above, const Surface& below) {
    const std::string &top = scene.objects[above.object].name,
                      &bottom = scene.objects[below.object].name;
    const Surface& smaller = above.area < below.area ? above : below;
    std::vector<std::string> objects{top};
    if (bottom != top) objects.push_back(bottom);
    return {"coplanar-overlap", std::move(objects),
            (top == bottom ? "a polygon of " + quoted(top) + " lies in the plane of another of it"
                           : quoted(top) + " lies in the plane of " + quoted(bottom)) +
                " and, being listed later, covers it near " +
                place_text(centroid(smaller.corners, smaller.normal), scene_size(scene)),
            "raise it by more than 1e-6 of the scene's size, or cut the hole it fills", 1};
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

CoplanarOverlaps find_coplanar_overlaps(const Scene& scene) {
    const std::size_t n = scene.surfaces.size();
    const double reach = contact_distance(scene);
    CoplanarOverlaps overlaps{std::vector<std::vector<SurfaceIndex>>(n),
                              std::vector<std::vector<SurfaceIndex>>(n)};
    for_each_touching_pair(scene, reach, [&](SurfaceIndex a, SurfaceIndex b) {
        const Surface &first = scene.surfaces[a], &later = scene.surfaces[b];
        if (!overlap(first, later, reach)) return;
        overlaps.partners[a].push_back(b);
        overlaps.partners[b].push_back(a);
        if (first.normal.dot(later.normal) > 0.0) overlaps.covered_by[a].push_back(b);
    });
    for (auto& partners : overlaps.partners) std::sort(partners.begin(), partners.end());
    for (auto& covers : overlaps.covered_by) std::sort(covers.begin(), covers.end());
    return overlaps;
}

std::vector<Finding> overlap_findings(const Scene& scene, const CoplanarOverlaps& overlaps) {
    std::map<std::pair<ObjectIndex, ObjectIndex>, std::size_t> number_of;
    std::vector<Finding> findings;
    for (SurfaceIndex s = 0; s < scene.surfaces.size(); ++s)
        for (const SurfaceIndex cover : overlaps.covered_by[s]) {
            const Surface &below = scene.surfaces[s], &above = scene.surfaces[cover];
            const auto [known, is_new] =
                number_of.emplace(std::pair(above.object, below.object), findings.size());
            if (!is_new) {
                ++findings[known->second].count;
                continue;
            }
            findings.push_back(overlap_finding(scene, above, below));
        }
    return findings;
}

}  // namespace patchlight
