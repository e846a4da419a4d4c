#include "raster/tone.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patchlight::raster {
namespace {

/// steps[k] is the least light that is shown as k + 1.
std::array<float, 255> brightness_steps() {
    std::array<float, 255> steps{};
    for (std::size_t k = 0; k < steps.size(); ++k)
        steps[k] = static_cast<float>(linear_from_srgb((static_cast<double>(k) + 0.5) / 255.0));
    return steps;
}

std::uint8_t shown(float light, const std::array<float, 255>& steps) {
    if (!(light > 0.0F)) return 0;
    return static_cast<std::uint8_t>(std::upper_bound(steps.begin(), steps.end(), light) -
                                     steps.begin());
}

}  // namespace

double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double linear_from_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::vector<std::uint8_t> tone_mapped(const Image& image, double exposure) {
    static const std::array<float, 255> steps = brightness_steps();
    const double gain = std::exp2(exposure);
    std::vector<std::uint8_t> bytes(image.rgb.size());
    std::transform(image.rgb.begin(), image.rgb.end(), bytes.begin(),
                   [&](float light) { return shown(static_cast<float>(light * gain), steps); });
    return bytes;
}

}  // namespace patchlight::raster
