#include "raster/tone.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

namespace patchlight::raster::tone_test {
namespace {

int shown(float light, double exposure = 0.0) {
    return tone_mapped({1, 1, {light, 0.0F, 0.0F}}, exposure)[0];
}

TEST(Tone, KnownLightGivesKnownBytes) {
    EXPECT_EQ(shown(0.0F), 0);
    EXPECT_EQ(shown(0.5F), 188);
    EXPECT_EQ(shown(0.2140411F), 127);  // sRGB of 127.5 rounds at this point: just below
    EXPECT_EQ(shown(0.2140412F), 128);
    EXPECT_EQ(shown(0.0031308F), 10);
    EXPECT_EQ(shown(1.0F), 255);
    EXPECT_EQ(shown(7.0F), 255);
}

TEST(Tone, EveryByteComesBackFromItsOwnLight) {
    for (int byte = 0; byte < 256; ++byte)
        EXPECT_EQ(shown(static_cast<float>(linear_from_srgb(byte / 255.0))), byte);
}

TEST(Tone, RoundsToTheNearestByte) {
    for (int i = 0; i <= 5000; ++i) {
        const double encoded = 255.0 * srgb_from_linear(static_cast<float>(i) / 5000.0F);
        const double single_precision = 1e-4;  // of the light, seen where the curve is steepest
        EXPECT_NEAR(shown(static_cast<float>(i) / 5000.0F), encoded, 0.5 + single_precision);
    }
}

TEST(Tone, OneStopMoreIsTwiceTheLight) {
    EXPECT_EQ(shown(0.25F, 1.0), shown(0.5F));
    EXPECT_EQ(shown(0.8F, -2.0), shown(0.2F));
    EXPECT_EQ(shown(0.5F, 2000.0), 255);
    EXPECT_EQ(shown(0.0F, 2000.0), 0);
    EXPECT_EQ(shown(0.5F, -2000.0), 0);
}

TEST(Tone, LightThatIsNoneShowsBlack) {
    EXPECT_EQ(shown(-1.0F), 0);
    EXPECT_EQ(shown(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(shown(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(shown(-std::numeric_limits<float>::infinity()), 0);
}

}  // namespace
}  // namespace patchlight::raster::tone_test
