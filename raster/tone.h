#pragma once

#include "raster/image.h"

#include <cstdint>
#include <vector>

namespace patchlight::raster {

/// The sRGB transfer curve, linear in [0, 1] to encoded in [0, 1].
/// IEC 61966-2-1, "Default RGB colour space - sRGB", 1999.
double srgb_from_linear(double linear);

/// Its inverse.
double linear_from_srgb(double encoded);

/// What a screen shows: sRGB(min(1, L 2^exposure)) per channel in 8 bits, rounded to the nearest.
/// Negative light and NaN show as 0. Size and order as image.rgb.
std::vector<std::uint8_t> tone_mapped(const Image& image, double exposure);

}  // namespace patchlight::raster
