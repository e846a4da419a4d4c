#include "solver/form_factors/point_factor.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace patchlight {

namespace {

constexpr double far_squared = 1e6;  // distance over size, squared: Lambert's sum would cancel [1]

double kernel_factor(const Vec3& point, const Vec3& normal, const ConvexPolygon& polygon,
                     const Vec3& polygon_normal) {
    Vec3 centre = Vec3::Zero(), twice_area = Vec3::Zero();
    for (std::size_t k = 0; k < polygon.size; ++k) {
        centre += polygon.corners[k] / static_cast<double>(polygon.size);
        if (k + 1 < polygon.size)
            twice_area += (polygon.corners[k] - polygon.corners[0])
                              .cross(polygon.corners[k + 1] - polygon.corners[0]);
    }
    const Vec3 ray = centre - point;
    const double r2 = ray.squaredNorm();
    return -ray.dot(normal) * ray.dot(polygon_normal) * 0.5 * twice_area.norm() /
           (std::numbers::pi * r2 * r2);
}

}  // namespace

double point_factor(const Vec3& point, const Vec3& normal, const ConvexPolygon& whole,
                    const Vec3& polygon_normal) {
    if ((point - whole.corners[0]).dot(polygon_normal) <= 0.0) return 0.0;
    const ConvexPolygon polygon = clip_to_front(whole, point, normal);
    if (polygon.size < 3) return 0.0;
    const double size2 = (polygon.corners[2] - polygon.corners[0]).squaredNorm();
    if ((polygon.corners[0] - point).squaredNorm() > far_squared * size2)
        return std::max(0.0, kernel_factor(point, normal, polygon, polygon_normal));
    double sum = 0.0;
    Vec3 from = polygon.corners[polygon.size - 1] - point;
    for (std::size_t k = 0; k < polygon.size; ++k) {
        const Vec3 to = polygon.corners[k] - point;
        const Vec3 across = from.cross(to);
        const double length = across.norm();
        if (length > 0.0) sum -= across.dot(normal) / length * std::atan2(length, from.dot(to));
        from = to;
    }
    return std::max(0.0, sum / (2.0 * std::numbers::pi));
}

}  // namespace patchlight
