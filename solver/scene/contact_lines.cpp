#include "solver/scene/contact_lines.h"

#include "solver/scene/polygon.h"
#include "solver/scene/touching_pairs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace patchlight {

namespace {

double distance_to_line(const Vec3& a, const Vec3& b, const Vec3& p) {
    const Vec3 along = (b - a).normalized();
    return (p - a - (p - a).dot(along) * along).norm();
}

bool along_own_edge(const Surface& surface, const Segment& s, double reach) {
    const std::size_t n = surface.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3 &a = surface.corners[k], &b = surface.corners[(k + 1) % n];
        if (distance_to_line(a, b, s[0]) <= reach && distance_to_line(a, b, s[1]) <= reach)
            return true;
    }
    return false;
}

/// Segments in which polygon `other` meets the plane of `surface`.
std::vector<Segment> meet_plane(const Surface& surface, const Surface& other, double reach) {
    const std::size_t n = other.corners.size();
    std::vector<double> height(n);
    for (std::size_t k = 0; k < n; ++k)
        height[k] = (other.corners[k] - surface.corners[0]).dot(surface.normal);
    std::vector<Segment> segments;
    std::vector<Vec3> crossings;
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t l = (k + 1) % n;
        const Vec3 &p = other.corners[k], &q = other.corners[l];
        if (std::abs(height[k]) <= reach && std::abs(height[l]) <= reach) {
            segments.push_back({p, q});
            continue;
        }
        // A corner in the plane counts as above it, so that each passage through is met once.
        const bool p_above = height[k] >= -reach, q_above = height[l] >= -reach;
        if (p_above != q_above)
            crossings.push_back(p + (q - p) * (height[k] / (height[k] - height[l])));
    }
    const Vec3 line = surface.normal.cross(other.normal);
    std::sort(crossings.begin(), crossings.end(),
              [&](const Vec3& a, const Vec3& b) { return a.dot(line) < b.dot(line); });
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)  // in, out, in, out
        if ((crossings[k + 1] - crossings[k]).norm() > reach)
            segments.push_back({crossings[k], crossings[k + 1]});
    return segments;
}

}  // namespace

bool reaches_inside(const Surface& surface, const Segment& s, double reach) {
    const PlaneFrame frame = frame_along(surface.corners, surface.normal);
    std::vector<Vec2> outline;
    for (const Vec3& p : surface.corners) outline.push_back(frame.flat(p));
    if (along_own_edge(surface, s, reach)) return false;
    // Cut at the outline; the middles of the parts tell.
    const Vec2 a = frame.flat(s[0]), b = frame.flat(s[1]);
    std::vector<double> places{0.0, 1.0};
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec2 &p = outline[k], &q = outline[(k + 1) % outline.size()];
        const double at_a = turn(p, q, a), at_b = turn(p, q, b);
        if ((at_a > 0.0) != (at_b > 0.0)) places.push_back(at_a / (at_a - at_b));
    }
    std::sort(places.begin(), places.end());
    for (std::size_t k = 1; k < places.size(); ++k)
        if ((places[k] - places[k - 1]) * (b - a).norm() > reach &&
            contains(outline, a + 0.5 * (places[k] + places[k - 1]) * (b - a)))
            return true;
    return false;
}

std::vector<std::vector<Segment>> find_contact_lines(const Scene& scene,
                                                     const CoplanarOverlaps& overlaps,
                                                     const std::function<bool()>& go_on) {
    const LocalTolerance tolerance(scene);
    std::vector<std::vector<Segment>> lines(scene.surfaces.size());
    const auto add = [&](SurfaceIndex s, SurfaceIndex other) {
        const Surface &surface = scene.surfaces[s], &visitor = scene.surfaces[other];
        const double reach = tolerance.between(s, other);
        for (const Segment& segment : meet_plane(surface, visitor, reach)) {
            const bool known = std::any_of(lines[s].begin(), lines[s].end(), [&](const Segment& l) {
                return ((l[0] - segment[0]).norm() <= reach &&
                        (l[1] - segment[1]).norm() <= reach) ||
                       ((l[0] - segment[1]).norm() <= reach && (l[1] - segment[0]).norm() <= reach);
            });
            if (!known && reaches_inside(surface, segment, reach)) lines[s].push_back(segment);
        }
    };
    // Visitors one after another by number, whichever way the scene is turned.
    std::vector<std::vector<SurfaceIndex>> visitors(scene.surfaces.size());
    const auto covers = [&](SurfaceIndex s, SurfaceIndex other) {
        const std::vector<SurfaceIndex>& known = overlaps.covered_by[s];
        return std::binary_search(known.begin(), known.end(), other);
    };
    const auto visits = [&](SurfaceIndex s, SurfaceIndex other) {
        return !meet_plane(scene.surfaces[s], scene.surfaces[other], tolerance.between(s, other))
                    .empty();
    };
    struct Visit {
        SurfaceIndex other = 0;
        bool here = false, there = false;
    };
    std::vector<std::vector<Visit>> found(scene.surfaces.size());
    for_each_touching_pair(scene, tolerance, go_on, [&](SurfaceIndex a, SurfaceIndex b) {
        if (covers(a, b) || covers(b, a)) return;
        const Visit visit{b, visits(a, b), visits(b, a)};
        if (visit.here || visit.there) found[a].push_back(visit);
    });
    for (SurfaceIndex a = 0; a < found.size(); ++a)
        for (const Visit& visit : found[a]) {
            if (visit.here) visitors[a].push_back(visit.other);
            if (visit.there) visitors[visit.other].push_back(a);
        }
    for (std::vector<SurfaceIndex>& of : visitors) std::sort(of.begin(), of.end());
    for_each_in_parallel(visitors.size(), go_on, [&](std::size_t s) {
        for (const SurfaceIndex other : visitors[s]) add(static_cast<SurfaceIndex>(s), other);
    });
    return lines;
}

}  // namespace patchlight
