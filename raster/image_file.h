#pragma once

#include "raster/image.h"

#include <string>

namespace patchlight::raster {

// Files are made in memory, to be written by write_whole or sent as they are. The same image gives
// the same bytes, whenever it is encoded. PNG and EXR throw std::runtime_error if the image module
// (see image_module.h) cannot be loaded or refuses.

/// 8 bits a channel, tone mapped with the exposure in stops (see tone.h).
std::string encode_png(const Image& image, double exposure);

/// Linear light, 32-bit float RGB, top row first, ZIP compressed.
std::string encode_exr(const Image& image);

/// Linear light, three channels, little-endian, bottom row first. Needs no module.
/// Format: Debevec, "PFM Portable FloatMap Image Format".
std::string encode_pfm(const Image& image);

}  // namespace patchlight::raster
