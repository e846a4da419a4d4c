#pragma once

#include "raster/image.h"
#include "raster/quantity_image.h"

#include <string>
#include <vector>

namespace patchlight::raster {

/// What a bar of colours says.
struct ColourScale {
    ShownRange range;
    std::vector<std::string> title;  // above the bar, line by line
};

/// The picture with a bar of the colours at its right, numbered at round numbers: as high as it
/// was, wider by some fifth. For exposure 0.
Image with_colour_scale(const Image& picture, const ColourScale& scale);

}  // namespace patchlight::raster
