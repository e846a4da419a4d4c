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

double signed_area(std::span<const Vec2> p) {
    double area = 0.0;
    for (std::size_t k = 1; k + 1 < p.size(); ++k) area += 0.5 * turn(p[0], p[k], p[k + 1]);
    return area;
}

PlaneFrame frame_of(const Vec3& origin, const Vec3& n) {
    // Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z());
    const double b = n.x() * n.y() * a;
    return {origin, Vec3(1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()),
            Vec3(b, sign + n.y() * n.y() * a, -n.y()), n};
}

PlaneFrame frame_along(const Vec3& origin, const Vec3& edge, const Vec3& n) {
    const Vec3 across = n.cross(edge);
    const double length = across.norm();
    if (!(length > 0.0)) return frame_of(origin, n);
    const Vec3 v = across / length;
    return {origin, v.cross(n), v, n};
}

PlaneFrame frame_along(std::span<const Vec3> corners, const Vec3& n) {
    return frame_along(corners[0], corners[1] - corners[0], n);
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
    constexpr double on_edge = 1e-11;  // of the extent: no corner, however it was rounded [1]
    std::vector<std::pair<Vec2, std::size_t>> sorted;
    Eigen::AlignedBox2d box;
    for (std::size_t k = 0; k < points.size(); ++k) {
        sorted.emplace_back(frame.flat(points[k]), k);
        box.extend(sorted.back().first);
    }
    const double least = points.empty() ? 0.0 : on_edge * box.sizes().maxCoeff() + 1e-300;
    const auto is_corner = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
        return turn(a, b, c) > least * (c - a).norm();
    };
    // A column's points by height, whatever rounding makes of x.
    std::sort(sorted.begin(), sorted.end(), [least](const auto& a, const auto& b) {
        const double column_a = std::round(a.first.x() / least),
                     column_b = std::round(b.first.x() / least);
        return std::pair(column_a, a.first.y()) < std::pair(column_b, b.first.y());
    });
    std::vector<Vec3> hull;
    const auto half = [&](auto begin, auto end) {
        std::vector<std::pair<Vec2, std::size_t>> chain;
        for (auto at = begin; at != end; ++at) {
            while (chain.size() >= 2 &&
                   !is_corner(chain[chain.size() - 2].first, chain.back().first, at->first))
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
