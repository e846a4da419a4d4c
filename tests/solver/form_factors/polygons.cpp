#include "tests/solver/form_factors/polygons.h"

#include "solver/form_factors/point_factor.h"
#include "solver/scene/polygon.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patchlight {

ConvexPolygon convex(const Polygon& polygon) {
    ConvexPolygon result;
    for (const Vec3& p : polygon) result.add(p);
    return result;
}

std::vector<ConvexPolygon> fan(const Polygon& polygon) {
    constexpr std::size_t together = 6;  // edges in one of the small polygons
    Vec3 centre = Vec3::Zero();
    for (const Vec3& p : polygon) centre += p / static_cast<double>(polygon.size());
    std::vector<ConvexPolygon> parts;
    for (std::size_t first = 0; first < polygon.size(); first += together) {
        parts.emplace_back();
        parts.back().add(centre);
        for (std::size_t k = first; k <= std::min(first + together, polygon.size()); ++k)
            parts.back().add(polygon[k % polygon.size()]);
    }
    return parts;
}

Polygon random_facet(std::mt19937& chance) {
    return random_facet(chance, uniform(chance) < 0.3 ? 3 : 4);
}

Polygon random_facet(std::mt19937& chance, int corners) {
    const PlaneFrame frame = frame_of(Vec3::Zero(), random_direction(chance));
    Polygon facet;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2.0 * std::numbers::pi * (k + 0.4 * uniform(chance)) / corners;
        const double radius = 0.8 + 0.3 * uniform(chance);
        facet.push_back(frame.lift({radius * std::cos(angle), radius * std::sin(angle)}));
    }
    return facet;
}

Vec3 normal_of(const Polygon& polygon) { return vector_area(polygon).normalized(); }

bool face_each_other(const Polygon& p, const Polygon& q) {
    const auto in_front = [](const Polygon& a, const Polygon& of) {
        return std::all_of(a.begin(), a.end(), [&](const Vec3& corner) {
            return (corner - of[0]).dot(normal_of(of)) > 0.0;
        });
    };
    return in_front(p, q) && in_front(q, p);
}

double exchange_by_quadrature(const Polygon& p, const Polygon& q) {
    // Tanh–sinh in both directions (Takahasi & Mori, 1974).
    constexpr double step = 0.09;
    constexpr int reach = 36;
    std::vector<double> nodes, weights;
    for (int k = -reach; k <= reach; ++k) {
        const double s = 0.5 * std::numbers::pi * std::sinh(step * k);
        nodes.push_back(1.0 / (1.0 + std::exp(-2.0 * s)));
        weights.push_back(step * 0.25 * std::numbers::pi * std::cosh(step * k) /
                          (std::cosh(s) * std::cosh(s)));
    }
    const ConvexPolygon target = convex(q);
    const Vec3 normal_p = normal_of(p), normal_q = normal_of(q);
    double sum = 0.0;
    for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b) {
            const double u = nodes[a], v = nodes[b];
            const Vec3 x = (1 - v) * ((1 - u) * p[0] + u * p[1]) + v * ((1 - u) * p[3] + u * p[2]);
            const Vec3 along_u = (1 - v) * (p[1] - p[0]) + v * (p[2] - p[3]),
                       along_v = (1 - u) * (p[3] - p[0]) + u * (p[2] - p[1]);
            sum += weights[a] * weights[b] * along_u.cross(along_v).norm() *
                   point_factor(x, normal_p, target, normal_q);
        }
    return sum;
}

}  // namespace patchlight
