#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace patchlight {

/// Slope of log y over log x by least squares, and its standard error.
struct Slope {
    double value = 0.0, error = 0.0;
};

inline Slope fit_slope(const std::vector<double>& x, const std::vector<double>& y) {
    const double n = static_cast<double>(x.size());
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double a = std::log(x[k]), b = std::log(y[k]);
        sx += a, sy += b, sxx += a * a, sxy += a * b;
    }
    const double spread = sxx - sx * sx / n;
    Slope slope;
    slope.value = (sxy - sx * sy / n) / spread;
    const double level = (sy - slope.value * sx) / n;
    double misfit = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k)
        misfit += std::pow(std::log(y[k]) - level - slope.value * std::log(x[k]), 2);
    slope.error = std::sqrt(misfit / (n - 2.0) / spread);
    return slope;
}

}  // namespace patchlight
