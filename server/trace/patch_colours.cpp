#include "server/trace/patch_colours.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace patchlight::server {
namespace {

/// From hue, on a circle of 1, at full saturation mixed with some white.
Eigen::Array3d coloured(double hue, double lightness) {
    Eigen::Array3d colour;
    for (int c = 0; c < 3; ++c) {
        const double wave = std::cos(2.0 * std::numbers::pi * (hue - c / 3.0));
        colour[c] = std::pow(0.5 + 0.45 * wave, 2.2) * lightness;
    }
    return colour;
}

/// Evenly over [0, 1), neighbours far apart.
double scattered(std::uint32_t number) {
    return static_cast<double>(number * 2654435769u) / 4294967296.0;
}

}  // namespace

PatchColours::PatchColours(const Scene& scene, const PatchMesh& mesh) {
    colours_.reserve(mesh.size());
    for (PatchIndex i = 0; i < mesh.size(); ++i) {
        const ObjectIndex object = scene.surfaces[mesh.patches[i].surface].object;
        colours_.push_back(coloured(scattered(object), 0.35 + 0.65 * scattered(i)));
    }
}

}  // namespace patchlight::server
