#include "solver/form_factors/hemicube_cells.h"

#include <cmath>
#include <numbers>

namespace patchlight {

HemicubeCells::HemicubeCells(int resolution)
    : width_(resolution), side_height_((resolution + 1) / 2) {
    const double dx = 2.0 / width_, dz = 1.0 / side_height_;
    const auto delta = [](double cosine, double squared, double area) {
        return cosine * area / (std::numbers::pi * squared * squared);
    };
    double top_sum = 0.0, side_sum = 0.0;
    for (int row = 0; row < width_; ++row)
        for (int column = 0; column < width_; ++column) {
            const double x = -1.0 + (column + 0.5) * dx, y = 1.0 - (row + 0.5) * dx;
            top_.push_back(delta(1.0, x * x + y * y + 1.0, dx * dx));
            top_sum += top_.back();
        }
    for (int row = 0; row < side_height_; ++row)
        for (int column = 0; column < width_; ++column) {
            const double x = -1.0 + (column + 0.5) * dx, z = 1.0 - (row + 0.5) * dz;
            side_.push_back(delta(z, x * x + z * z + 1.0, dx * dz));
            side_sum += side_.back();
        }
    raw_sum_ = top_sum + 4.0 * side_sum;
    for (double& share : top_) share /= raw_sum_;
    for (double& share : side_) share /= raw_sum_;
}

}  // namespace patchlight
