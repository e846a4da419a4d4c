#pragma once

#include <Eigen/Core>

#include <string_view>

namespace patchlight::raster {

/// Mean of the pixels of a PNG, JPEG or EXR file, in linear light [1]: sRGB is decoded, EXR is
/// linear as it is. `by_opacity`: pixels count as much as they are opaque. Throws
/// std::runtime_error if it cannot be read, or the image module (see image_module.h) cannot be
/// loaded.
Eigen::Array3d mean_colour(std::string_view file_bytes, bool by_opacity);

}  // namespace patchlight::raster
