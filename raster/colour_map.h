#pragma once

#include <Eigen/Core>

namespace patchlight::raster {

/// The colour that stands for a share of the range, 0 to 1 (clamped): from a dark blue by way of
/// violet, red and orange to a light yellow, in linear sRGB, each channel in [0, 1]. Equal steps of
/// the share are equally far apart to the eye, and it only ever gets lighter, so that it can be
/// read without colours too, in print or by the colour-blind.
/// The path is an arc through the colour space Oklab: Ottosson, "A perceptual color space for image
/// processing", 2020.
Eigen::Array3d mapped_colour(double share);

}  // namespace patchlight::raster
