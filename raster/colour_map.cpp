#include "raster/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace patchlight::raster {
namespace {

constexpr std::size_t steps = 1024;

/// Lightness and the two opponent axes. Along the path lightness and hue run evenly; chroma swells
/// in the middle as far as sRGB has room for it.
Eigen::Array3d oklab_on_path(double way) {
    constexpr double darkest = 0.20, lightest = 0.94;
    constexpr double blue = 275.0, yellow = 460.0;  // hues, by way of red [degrees]
    constexpr double least_chroma = 0.09, swell = 0.09;
    const double hue = (blue + (yellow - blue) * way) * std::numbers::pi / 180.0;
    const double chroma = least_chroma + swell * std::sin(std::numbers::pi * way);
    return {darkest + (lightest - darkest) * way, chroma * std::cos(hue), chroma * std::sin(hue)};
}

Eigen::Array3d linear_srgb(const Eigen::Array3d& lab) {
    Eigen::Matrix3d cones_of_lab, srgb_of_cones;
    cones_of_lab << 1, 0.3963377774, 0.2158037573,  //
        1, -0.1055613458, -0.0638541728,            //
        1, -0.0894841775, -1.2914855480;
    srgb_of_cones << 4.0767416621, -3.3077115913, 0.2309699292,  //
        -1.2684380046, 2.6097574011, -0.3413193965,              //
        -0.0041960863, -0.7034186147, 1.7076147010;
    const Eigen::Vector3d cones = (cones_of_lab * lab.matrix()).array().cube();
    return (srgb_of_cones * cones).array();
}

using Table = std::array<Eigen::Array3d, steps + 1>;

/// Points at equal distances along the path.
Table make_table() {
    std::array<double, steps + 1> length{};
    for (std::size_t k = 1; k <= steps; ++k) {
        const auto at = [](std::size_t step) {
            return oklab_on_path(static_cast<double>(step) / steps);
        };
        length[k] = length[k - 1] + (at(k) - at(k - 1)).matrix().norm();
    }
    Table table;
    std::size_t before = 0;
    for (std::size_t k = 0; k <= steps; ++k) {
        const double wanted = length[steps] * static_cast<double>(k) / steps;
        while (before + 1 < steps && length[before + 1] < wanted) ++before;
        const double part = (wanted - length[before]) / (length[before + 1] - length[before]);
        table[k] = linear_srgb(oklab_on_path((static_cast<double>(before) + part) / steps));
    }
    return table;
}

}  // namespace

Eigen::Array3d mapped_colour(double share) {
    static const Table table = make_table();
    if (!(share > 0.0)) return table.front();
    const double place = std::min(share, 1.0) * steps;
    const auto below = std::min(static_cast<std::size_t>(place), steps - 1);
    const double part = place - static_cast<double>(below);
    return (1.0 - part) * table[below] + part * table[below + 1];
}

}  // namespace patchlight::raster
