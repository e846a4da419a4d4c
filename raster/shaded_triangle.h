#pragma once

#include "raster/project.h"
#include "raster/scan_convert.h"

#include <array>
#include <optional>

namespace patchlight::raster {

/// A triangle on the screen, ready to be drawn as often as it meets a band of the picture.
struct ShadedTriangle {
    ScreenCorners corners;
    ScreenPlane nearness;
    ScreenPlane inverse_w;
    std::array<ScreenPlane, 3> colour_over_w;  // linear on the screen, as colour itself is not
    // What the corners span: at the rim of a sliver, samples may lie a rounding outside of it,
    // where its planes are steep.
    float farthest = 0.0F;
    float nearest = 0.0F;
    std::array<float, 3> darkest{};
    std::array<float, 3> brightest{};
};

/// Empty if the corners run clockwise as the eye sees them, or enclose no area.
std::optional<ShadedTriangle> shaded_triangle(const ScreenCorner& a, const ScreenCorner& b,
                                              const ScreenCorner& c);

}  // namespace patchlight::raster
