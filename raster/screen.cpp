#include "raster/screen.h"

#include "raster/sample_pattern.h"

#include <algorithm>
#include <cmath>

namespace patchlight::raster {
namespace {

std::int32_t snap(double pixels, int size) {
    const double inside = std::clamp(pixels, 0.0, static_cast<double>(size));
    return static_cast<std::int32_t>(std::lround(inside * subpixels));
}

}  // namespace

std::optional<ScreenVertex> screen_vertex(const Eigen::Vector4d& position,
                                          const Viewport& viewport) {
    ScreenVertex vertex;
    vertex.inverse_w = 1.0 / position.w();
    vertex.x = 0.5 * viewport.width * (1.0 + position.x() * vertex.inverse_w);
    vertex.y = 0.5 * viewport.height * (1.0 - position.y() * vertex.inverse_w);
    vertex.nearness = (position.z() + 1.0) * vertex.inverse_w;
    if (!std::isfinite(vertex.x + vertex.y + vertex.nearness + vertex.inverse_w))
        return std::nullopt;
    vertex.snapped = {snap(vertex.x, viewport.width), snap(vertex.y, viewport.height)};
    return vertex;
}

// Olano & Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", 1997.
bool faces_eye(const Eigen::Vector4d& a, const Eigen::Vector4d& b, const Eigen::Vector4d& c) {
    return a.x() * (b.y() * c.w() - c.y() * b.w()) + b.x() * (c.y() * a.w() - a.y() * c.w()) +
               c.x() * (a.y() * b.w() - b.y() * a.w()) >
           0.0;
}

PlaneFit::PlaneFit(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c)
    : x_(a.x), y_(a.y) {
    const double b_x = b.x - a.x;
    const double b_y = b.y - a.y;
    const double c_x = c.x - a.x;
    const double c_y = c.y - a.y;
    const double area = b_x * c_y - c_x * b_y;
    // Without an area there is no slope worth having; the value at corner a is as good as any.
    const double inverse = std::abs(area) > 1e-12 ? 1.0 / area : 0.0;
    b_dx_ = c_y * inverse;
    c_dx_ = -b_y * inverse;
    b_dy_ = -c_x * inverse;
    c_dy_ = b_x * inverse;
}

ScreenPlane PlaneFit::through(double value_a, double value_b, double value_c) const {
    ScreenPlane plane;
    plane.dx = b_dx_ * (value_b - value_a) + c_dx_ * (value_c - value_a);
    plane.dy = b_dy_ * (value_b - value_a) + c_dy_ * (value_c - value_a);
    plane.at_origin = value_a - plane.dx * x_ - plane.dy * y_;
    return plane;
}

}  // namespace patchlight::raster
