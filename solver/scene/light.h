#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace patchlight {

using Vec3 = Eigen::Vector3d;  // a point or a direction [m] or [1]
using Rgb = Eigen::Array3d;    // one quantity per channel

/// The scalar of a triple: Y = 0.2126 R + 0.7152 G + 0.0722 B (ITU-R BT.709), so a grey x stays x,
/// to the last bit.
inline double luminance(const Rgb& rgb) {
    return rgb[1] + 0.2126 * (rgb[0] - rgb[1]) + 0.0722 * (rgb[2] - rgb[1]);
}

}  // namespace patchlight
