#include "tests/solver/form_factors/closed_forms.h"

#include <cmath>
#include <numbers>

namespace patchlight {

namespace {
constexpr long double pi = std::numbers::pi_v<long double>;
}

double parallel_rectangles(double x, double y, double z) {
    const long double a = static_cast<long double>(x) / z, b = static_cast<long double>(y) / z;
    const long double a2 = 1 + a * a, b2 = 1 + b * b;
    const long double sum = std::log(std::sqrt(a2 * b2 / (a2 + b2 - 1))) +
                            a * std::sqrt(b2) * std::atan(a / std::sqrt(b2)) +
                            b * std::sqrt(a2) * std::atan(b / std::sqrt(a2)) - a * std::atan(a) -
                            b * std::atan(b);
    return static_cast<double>(2 / (pi * a * b) * sum);
}

double perpendicular_rectangles(double edge, double width, double height) {
    const long double h = static_cast<long double>(height) / edge,
                      w = static_cast<long double>(width) / edge;
    const long double h2 = h * h, w2 = w * w, both = std::sqrt(h2 + w2);
    const long double logarithm = std::log((1 + w2) * (1 + h2) / (1 + w2 + h2)) +
                                  w2 * std::log(w2 * (1 + w2 + h2) / ((1 + w2) * (w2 + h2))) +
                                  h2 * std::log(h2 * (1 + h2 + w2) / ((1 + h2) * (h2 + w2)));
    return static_cast<double>(
        (w * std::atan(1 / w) + h * std::atan(1 / h) - both * std::atan(1 / both) + logarithm / 4) /
        (pi * w));
}

}  // namespace patchlight
