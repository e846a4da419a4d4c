#pragma once

#include "raster/camera.h"
#include "raster/image.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace patchlight::raster {

/// One quantity as a camera sees it on surfaces.
struct QuantityImage {
    int width = 0;                // [pixels]
    int height = 0;               // [pixels]
    std::vector<float> quantity;  // mean over the part of the pixel where a surface is seen; else 0
    std::vector<float> coverage;  // that part, 0 to 1; pinholes count as covered [1]
};

/// A quantity given at the vertices, seen as render shows light (see render.h).
QuantityImage render_quantity(const Camera& camera, std::span<const Eigen::Vector3d> positions,
                              std::span<const double> quantity,
                              std::span<const std::array<std::uint32_t, 3>> triangles);

/// The quantity itself, three times.
Image grey_image(const QuantityImage& seen);

/// What is shown in one colour each, from the least to the most; beyond them as at them.
struct ShownRange {
    double least = 0.0;
    double most = 1.0;
};

/// In the colours of colour_map.h, on neutral grey; for exposure 0.
Image false_colour_image(const QuantityImage& seen, const ShownRange& range);

/// The grey behind what is shown, linear.
inline constexpr double background_grey = 0.6;

}  // namespace patchlight::raster
