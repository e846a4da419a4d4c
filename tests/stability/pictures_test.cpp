#include "raster/render.h"
#include "raster/tone.h"
#include "tests/raster/meshes.h"
#include "tests/stability/judgement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlight::stability::pictures_test {
namespace {

/// A white room with a white block seen from within: every sample of every pixel is white, if none
/// lies in a gap.
TEST(Pictures, HaveNoGapsBetweenTriangles) {
    double worst = 0.0;
    for (const int cuts : {1, 3, 7}) {
        raster::Mesh room = raster::room_with_block(cuts);
        std::fill(room.colours.begin(), room.colours.end(), Eigen::Array3d::Ones());
        const raster::Image image = raster::render(raster::room_camera(160), room.view());
        for (const float value : image.rgb)
            worst = std::max(worst, std::abs(static_cast<double>(value) - 1.0));
    }
    constexpr double rounding = 1e-6;  // colours are floats, over w and back
    judge_all("D7", worst, rounding);
}

/// A lamp of 1000, a wall of 1e-3, what is no number, and a grey of 0.216, 128 of 255 in sRGB.
TEST(Pictures, AreEncodedOnceAndHoldWhatIsBright) {
    const float nan = std::numeric_limits<float>::quiet_NaN(),
                infinite = std::numeric_limits<float>::infinity();
    raster::Image image{5, 1, {}};
    for (const float value : {1000.0F, 1e-3F, nan, infinite, 0.21586F})
        image.rgb.insert(image.rgb.end(), 3, value);
    const std::vector<std::uint8_t> shown = raster::tone_mapped(image, 0.0);
    double wrong = 0.0;
    const std::vector<std::uint8_t> right{255, 3, 0, 255, 128};
    for (std::size_t k = 0; k < shown.size(); ++k) wrong += shown[k] == right[k / 3] ? 0.0 : 1.0;
    judge_all("D8", wrong, 0.0);
}

}  // namespace
}  // namespace patchlight::stability::pictures_test
