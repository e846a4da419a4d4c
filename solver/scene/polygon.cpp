#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace patchlight {

Vec3 vector_area(std::span<const Vec3> corners) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
        sum += (corners[k] - corners[0]).cross(corners[k + 1] - corners[0]);
    return 0.5 * sum;
}

Vec3 centroid(std::span<const Vec3> corners, const Vec3& normal) {
    Vec3 moment = Vec3::Zero();
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vec3 a = corners[k] - corners[0];
        const Vec3 b = corners[k + 1] - corners[0];
        const double signed_area = 0.5 * a.cross(b).dot(normal);
        moment += signed_area * (a + b) / 3.0;
        area += signed_area;
    }
    return area > 0.0 ? Vec3(corners[0] + moment / area) : corners[0];
}

PlaneFrame frame_of(const Vec3& origin, const Vec3& n) {
    // Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z());
    const double b = n.x() * n.y() * a;
    return {origin, Vec3(1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
            Vec3(b, sign + n.y() * n.y() * a, -n.y()), n};
}

namespace {

bool in_closed_triangle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& q) {
    return turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 && turn(c, a, q) >= 0.0;
}

/// Smallest height of the triangle over its longest edge: 0 for a degenerate one.
double shape(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double longest =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return longest > 0.0 ? turn(a, b, c) / longest : 0.0;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Vec2> polygon) {
    std::vector<std::uint32_t> ring(polygon.size());
    std::iota(ring.begin(), ring.end(), 0u);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    while (ring.size() >= 3) {
        const std::size_t n = ring.size();
        std::size_t best = n;
        double best_shape = 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            const std::uint32_t ia = ring[(k + n - 1) % n], ib = ring[k], ic = ring[(k + 1) % n];
            const Vec2 &a = polygon[ia], &b = polygon[ib], &c = polygon[ic];
            const double ear_shape = shape(a, b, c);
            if (ear_shape <= std::max(best_shape, 1e-14)) continue;
            const bool is_ear = std::none_of(ring.begin(), ring.end(), [&](std::uint32_t i) {
                return i != ia && i != ib && i != ic && in_closed_triangle(a, b, c, polygon[i]);
            });
            if (!is_ear) continue;
            best = k;
            best_shape = ear_shape;
        }
        if (best == n) break;
        triangles.push_back({ring[(best + n - 1) % n], ring[best], ring[(best + 1) % n]});
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return triangles;
}

namespace {

bool segments_touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const double abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
    if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc != 0 && abd != 0 && cda != 0 &&
        cdb != 0)
        return true;
    const auto on = [](const Vec2& p, const Vec2& q, const Vec2& r, double area) {
        return area == 0.0 && (r - p).dot(r - q) <= 0.0;
    };
    return on(a, b, c, abc) || on(a, b, d, abd) || on(c, d, a, cda) || on(c, d, b, cdb);
}

}  // namespace

bool crosses_itself(std::span<const Vec2> polygon) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i + 2 < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;
            if (segments_touch(polygon[i], polygon[i + 1], polygon[j], polygon[(j + 1) % n]))
                return true;
        }
    return false;
}

bool contains(std::span<const Vec2> polygon, const Vec2& q) {
    bool inside = false;
    for (std::size_t k = 0, previous = polygon.size() - 1; k < polygon.size(); previous = k++) {
        const Vec2 &a = polygon[previous], &b = polygon[k];
        if ((a.y() > q.y()) == (b.y() > q.y())) continue;
        if (q.x() < (b.x() - a.x()) * (q.y() - a.y()) / (b.y() - a.y()) + a.x()) inside = !inside;
    }
    return inside;
}

std::vector<Vec3> convex_hull(std::span<const Vec3> points, const PlaneFrame& frame) {
    std::vector<std::pair<Vec2, std::size_t>> sorted;
    for (std::size_t k = 0; k < points.size(); ++k) sorted.emplace_back(frame.flat(points[k]), k);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
        return std::pair(a.first.x(), a.first.y()) < std::pair(b.first.x(), b.first.y());
    });
    std::vector<Vec3> hull;
    const auto half = [&](auto begin, auto end) {
        std::vector<std::pair<Vec2, std::size_t>> chain;
        for (auto at = begin; at != end; ++at) {
            while (chain.size() >= 2 &&
                   turn(chain[chain.size() - 2].first, chain.back().first, at->first) <= 0.0)
                chain.pop_back();
            chain.push_back(*at);
        }
        for (std::size_t k = 0; k + 1 < chain.size(); ++k) hull.push_back(points[chain[k].second]);
    };
    half(sorted.begin(), sorted.end());
    half(sorted.rbegin(), sorted.rend());
    return hull;
}

}  // namespace patchlight
