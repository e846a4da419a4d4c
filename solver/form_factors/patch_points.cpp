#include "solver/form_factors/patch_points.h"

#include "solver/form_factors/gauss_legendre.h"
#include "solver/rays/wide.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numbers>
#include <stdexcept>

namespace patchlight {

namespace {

template <std::size_t N>
void add_points(PatchPoints& points, const std::array<Vec3, 4>& p) {
    const GaussRule<N>& rule = gauss_rule<N>();
    for (std::size_t a = 0; a < N; ++a)
        for (std::size_t b = 0; b < N; ++b) {
            const double u = rule.nodes[a], v = rule.nodes[b];
            const Vec3 along_u = (1.0 - v) * (p[1] - p[0]) + v * (p[2] - p[3]);
            const Vec3 along_v = (1.0 - u) * (p[3] - p[0]) + u * (p[2] - p[1]);
            const Vec3 point =
                (1.0 - v) * ((1.0 - u) * p[0] + u * p[1]) + v * ((1.0 - u) * p[3] + u * p[2]);
            points.x.push_back(point.x());
            points.y.push_back(point.y());
            points.z.push_back(point.z());
            points.weight.push_back(rule.weights[a] * rule.weights[b] *
                                    along_u.cross(along_v).norm());
        }
}

struct Cloud {
    const double *x, *y, *z, *weight;
    double nx, ny, nz;
};

/// The compiler unrolls and vectorises the inner loop when N is known.
template <std::size_t N>
inline double product_sum(const Cloud& p, const Cloud& q) {
    double sum = 0.0;
    for (std::size_t a = 0; a < N; ++a) {
        double inner = 0.0;
        for (std::size_t b = 0; b < N; ++b) {
            const double dx = q.x[b] - p.x[a], dy = q.y[b] - p.y[a], dz = q.z[b] - p.z[a];
            const double squared = dx * dx + dy * dy + dz * dz;
            const double cosines =
                (dx * p.nx + dy * p.ny + dz * p.nz) * (dx * q.nx + dy * q.ny + dz * q.nz);
            inner += q.weight[b] * cosines / (squared * squared);
        }
        sum += p.weight[a] * inner;
    }
    return sum;
}

/// As many points as fill whole vectors; those past the end weigh nothing.
PATCHLIGHT_WIDE double product_sum_of(const Cloud& p, std::size_t p_count, const Cloud& q,
                                      std::size_t q_count) {
    double sum = 0.0;
    for (std::size_t a = 0; a < p_count; ++a) {
        double part[8] = {};
        for (std::size_t b = 0; b < q_count; b += 8)
            for (std::size_t k = 0; k < 8; ++k) {
                const double dx = q.x[b + k] - p.x[a], dy = q.y[b + k] - p.y[a],
                             dz = q.z[b + k] - p.z[a];
                const double squared = dx * dx + dy * dy + dz * dz;
                const double cosines =
                    (dx * p.nx + dy * p.ny + dz * p.nz) * (dx * q.nx + dy * q.ny + dz * q.nz);
                part[k] += q.weight[b + k] * cosines / (squared * squared);
            }
        sum += p.weight[a] * (((part[0] + part[4]) + (part[1] + part[5])) +
                              ((part[2] + part[6]) + (part[3] + part[7])));
    }
    return sum;
}

/// Points of a convex polygon, on the stack: quads 0-1-2-3, 0-3-4-5, ... with the last corner
/// repeated.
struct PolygonPoints {
    static constexpr std::size_t room = 32;  // three quads of nine, in whole vectors
    std::array<double, room> x, y, z, weight{};
    std::size_t count = 0;

    PolygonPoints(const ConvexPolygon& polygon, const Vec3& away) {
        x.fill(away.x()), y.fill(away.y()),
            z.fill(away.z());  // what weighs nothing must not divide by 0
        const GaussRule<3>& rule = gauss_rule<3>();
        for (std::size_t first = 1; first + 1 < polygon.size; first += 2) {
            const Vec3 &p0 = polygon.corners[0], &p1 = polygon.corners[first],
                       &p2 = polygon.corners[first + 1];
            const Vec3& p3 = polygon.corners[std::min(first + 2, polygon.size - 1)];
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < 3; ++b, ++count) {
                    const double u = rule.nodes[a], v = rule.nodes[b];
                    const Vec3 along_u = (1.0 - v) * (p1 - p0) + v * (p2 - p3);
                    const Vec3 along_v = (1.0 - u) * (p3 - p0) + u * (p2 - p1);
                    const Vec3 point =
                        (1.0 - v) * ((1.0 - u) * p0 + u * p1) + v * ((1.0 - u) * p3 + u * p2);
                    x[count] = point.x(), y[count] = point.y(), z[count] = point.z();
                    weight[count] =
                        rule.weights[a] * rule.weights[b] * along_u.cross(along_v).norm();
                }
        }
    }
    Cloud cloud(const Vec3& n) const {
        return {x.data(), y.data(), z.data(), weight.data(), n.x(), n.y(), n.z()};
    }
};

PATCHLIGHT_WIDE double product_sum_of_4(const Cloud& p, const Cloud& q) {
    return product_sum<4>(p, q);
}
PATCHLIGHT_WIDE double product_sum_of_9(const Cloud& p, const Cloud& q) {
    return product_sum<9>(p, q);
}
PATCHLIGHT_WIDE double product_sum_of_16(const Cloud& p, const Cloud& q) {
    return product_sum<16>(p, q);
}

}  // namespace

PatchPoints make_patch_points(const PatchMesh& mesh, int order) {
    PatchPoints points;
    points.per_patch = static_cast<std::size_t>(order * order);
    for (const Patch& patch : mesh.patches) {
        std::array<Vec3, 4> corners;
        for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.vertices[patch.vertices[k]];
        switch (order) {
            case 2:
                add_points<2>(points, corners);
                break;
            case 3:
                add_points<3>(points, corners);
                break;
            case 4:
                add_points<4>(points, corners);
                break;
            default:
                throw std::logic_error("no Gauss rule of this order");
        }
    }
    return points;
}

double kernel_exchange(const PatchPoints& points, PatchIndex i, const Vec3& n_i, PatchIndex j,
                       const Vec3& n_j) {
    const auto cloud = [&](PatchIndex patch, const Vec3& n) {
        const std::size_t at = patch * points.per_patch;
        return Cloud{&points.x[at], &points.y[at], &points.z[at], &points.weight[at],
                     n.x(),         n.y(),         n.z()};
    };
    const Cloud p = cloud(i, n_i), q = cloud(j, n_j);
    const double sum = points.per_patch == 4   ? product_sum_of_4(p, q)
                       : points.per_patch == 9 ? product_sum_of_9(p, q)
                                               : product_sum_of_16(p, q);
    return -sum / std::numbers::pi;
}

double kernel_exchange(const ConvexPolygon& p, const Vec3& n_p, const ConvexPolygon& q,
                       const Vec3& n_q) {
    const PolygonPoints points_p(p, q.corners[0]), points_q(q, 2.0 * q.corners[0] - p.corners[0]);
    return -product_sum_of(points_p.cloud(n_p), points_p.count, points_q.cloud(n_q),
                           (points_q.count + 7) / 8 * 8) /
           std::numbers::pi;
}

}  // namespace patchlight
