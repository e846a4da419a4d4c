#include "server/selftest/exact_factors.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace patchlight::server {
namespace {

/// Mean over the first rectangle of the sum over all corners of both, signs alternating.
template <class Corner>
double corner_sum(Interval a, Interval b, Interval c, Interval d, const Corner& corner) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            for (std::size_t k = 0; k < 2; ++k)
                for (std::size_t l = 0; l < 2; ++l)
                    sum += ((i + j + k + l) % 2 == 0 ? 1.0 : -1.0) * corner(a[i], b[j], c[k], d[l]);
    return sum / (2.0 * std::numbers::pi * (a[1] - a[0]) * (b[1] - b[0]));
}

double times_log(double factor, double argument) {
    return argument > 0.0 ? factor * std::log(argument) : 0.0;  // the limit
}

/// p √q atan(p / √q), q squared lengths.
double times_angle(double p, double q) {
    const double root = std::sqrt(q);
    return root > 0.0 ? p * root * std::atan(p / root) : 0.0;  // the limit
}

}  // namespace

double parallel_rectangles(Interval x, Interval y, Interval to_x, Interval to_y, double distance) {
    const double z2 = distance * distance;
    return corner_sum(x, y, to_y, to_x, [&](double a, double b, double c, double d) {
        const double u = a - d, v = b - c;
        return times_angle(v, u * u + z2) + times_angle(u, v * v + z2) -
               times_log(0.5 * z2, u * u + v * v + z2);
    });
}

double perpendicular_rectangles(Interval x, Interval y, Interval to_y, Interval to_z) {
    return corner_sum(x, y, to_y, to_z, [&](double a, double b, double c, double d) {
        const double v = b - c, q = a * a + d * d;
        return times_angle(v, q) - times_log(0.25 * (q - v * v), q + v * v);
    });
}

double element_to_polygon(const Vec3& point, const Vec3& normal, std::span<const Vec3> corners) {
    double sum = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 a = corners[k] - point, b = corners[(k + 1) % corners.size()] - point;
        const Vec3 across = b.cross(a);
        const double size = across.norm();
        if (size > 0.0) sum += std::atan2(size, a.dot(b)) / size * across.dot(normal);
    }
    return sum / (2.0 * std::numbers::pi);
}

double solid_angle(const Vec3& point, std::span<const Vec3> corners) {
    double sum = 0.0;
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const Vec3 a = corners[0] - point, b = corners[k + 1] - point, c = corners[k] - point;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += 2.0 * std::atan2(a.dot(b.cross(c)),
                                la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum;
}

}  // namespace patchlight::server
