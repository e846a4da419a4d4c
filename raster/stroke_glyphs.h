#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace patchlight::raster {

/// A connected stroke of the pen; y runs up from the baseline, a digit is 1 high.
using Stroke = std::vector<Eigen::Vector2d>;

struct Glyph {
    double width = 0.0;  // of its strokes' middle lines [digit heights]
    std::vector<Stroke> strokes;
};

/// The glyph of a character (UTF-8); nothing but a gap for those there are none of.
const Glyph& glyph_of(std::string_view character);

}  // namespace patchlight::raster
