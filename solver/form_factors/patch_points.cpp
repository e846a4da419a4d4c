#include "solver/form_factors/patch_points.h"

#include "solver/form_factors/gauss_legendre.h"
#include "solver/rays/wide.h"

#include <Eigen/Geometry>

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

}  // namespace patchlight
