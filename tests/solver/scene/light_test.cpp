#include "solver/scene/light.h"

#include <gtest/gtest.h>

namespace patchlight::light_test {
namespace {

TEST(Luminance, OfGreyIsTheGreyItselfToTheLastBit) {
    for (const double x : {0.0, 1.0, 0.1, 0.3, 0.7, 1.0 / 3.0, 17.3, 1e-30, 1e15})
        EXPECT_EQ(luminance(Rgb::Constant(x)), x);
}

TEST(Luminance, WeighsTheChannels) {
    EXPECT_DOUBLE_EQ(luminance(Rgb(1, 0, 0)), 0.2126);
    EXPECT_DOUBLE_EQ(luminance(Rgb(0, 1, 0)), 0.7152);
    EXPECT_DOUBLE_EQ(luminance(Rgb(0, 0, 1)), 0.0722);
}

}  // namespace
}  // namespace patchlight::light_test
