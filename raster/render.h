#pragma once

#include "raster/camera.h"
#include "raster/image.h"

#include <array>
#include <cstdint>
#include <span>

namespace patchlight::raster {

/// Triangles with a colour at every corner. The front is where corners run counter-clockwise.
struct TriangleView {
    std::span<const Eigen::Vector3d> positions;  // [scene length]
    std::span<const Eigen::Array3d> colours;     // one per position, linear radiance [W/(m² sr)]
    std::span<const std::array<std::uint32_t, 3>> triangles;  // indices into both
};

struct RenderSettings {
    int samples_per_axis = 4;  // 1 to 8; a pixel is the mean of the square of it [1]
};

/// The picture a camera takes: colours interpolated over each triangle with perspective, backs left
/// out, nearest surface seen; of coplanar surfaces (within a millionth of the depth) the one later
/// in the list. A pixel is the mean over its square, in linear light. Bands of the picture are
/// drawn in parallel; the result does not depend on the number of threads. Throws
/// std::invalid_argument for a camera that sees no volume or a picture above 16384 pixels an edge.
Image render(const Camera& camera, const TriangleView& view, const RenderSettings& settings = {});

}  // namespace patchlight::raster
