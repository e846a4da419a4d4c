#pragma once

#include <vector>

namespace patchlight::raster {

/// Linear radiance, three channels interleaved, top row first; 0 where nothing is seen.
struct Image {
    int width = 0;           // [pixels]
    int height = 0;          // [pixels]
    std::vector<float> rgb;  // size 3 * width * height [W/(m² sr)]
};

}  // namespace patchlight::raster
