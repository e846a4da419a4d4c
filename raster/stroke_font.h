#pragma once

#include "raster/image.h"

#include <Eigen/Core>
#include <string_view>

namespace patchlight::raster {

/// Where and how a line of text stands. Strokes are drawn with soft edges, so that any height does.
struct TextStyle {
    int height = 10;                              // of a digit [pixels]
    Eigen::Array3d ink = Eigen::Array3d::Zero();  // linear
};

/// Room that a text takes from its first to its last stroke [pixels].
double text_width(std::string_view text, const TextStyle& style);

/// Draws digits, "+-./" and the letters that units and their quantities need (UTF-8); others leave
/// a gap. `left` is where the first stroke begins and `baseline` where digits stand, from the top
/// left of the image [pixels]. What lies beyond the image is left out.
void draw_text(Image& image, std::string_view text, double left, double baseline,
               const TextStyle& style);

}  // namespace patchlight::raster
