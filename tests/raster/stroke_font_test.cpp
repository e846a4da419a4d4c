#include "raster/stroke_font.h"

#include "raster/stroke_glyphs.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <set>
#include <string>

namespace patchlight::raster::stroke_font_test {
namespace {

Image paper(int width, int height) {
    Image image{width, height, {}};
    image.rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0F);
    return image;
}

float at(const Image& image, int x, int y) {
    return image.rgb[3 * static_cast<std::size_t>(y * image.width + x)];
}

TEST(StrokeFont, HasWhatScalesNeed) {
    for (const char* character :
         {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9", ".", "-", "+", "/", "²",
          "e", "l", "x", "W", "m", "i", "u", "n", "a", "c", "r", "d", "f", "o", "t"})
        EXPECT_FALSE(glyph_of(character).strokes.empty()) << character;
    EXPECT_TRUE(glyph_of("q").strokes.empty());
}

TEST(StrokeFont, NoTwoDigitsLookAlike) {
    std::set<std::vector<float>> seen;
    for (const char* digit : {"0", "1", "2", "3", "4", "5", "6", "7", "8", "9"}) {
        Image image = paper(10, 14);
        draw_text(image, digit, 1, 12, {10, Eigen::Array3d::Zero()});
        seen.insert(image.rgb);
    }
    EXPECT_EQ(seen.size(), 10u);
}

TEST(StrokeFont, StaysWithinItsWidthAndHeight) {
    const TextStyle style{20, Eigen::Array3d::Zero()};
    const std::string text = "3.1e-05";
    const int width = static_cast<int>(text_width(text, style));
    Image image = paper(width + 40, 60);
    draw_text(image, text, 20, 40, style);
    int left = image.width, right = -1, top = image.height, bottom = -1;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            if (at(image, x, y) > 0.5F) continue;
            left = std::min(left, x), right = std::max(right, x);
            top = std::min(top, y), bottom = std::max(bottom, y);
        }
    EXPECT_NEAR(left, 20, 2);
    EXPECT_NEAR(right, 20 + width, 2);
    EXPECT_EQ(top, 20);
    EXPECT_EQ(bottom, 39);
}

TEST(StrokeFont, WhatLiesBeyondTheImageIsLeftOut) {
    Image image = paper(5, 5);
    for (const double left : {-100.0, -3.0, 3.0, 1e6})
        for (const double baseline : {-50.0, 2.0, 8.0, 1e6})
            draw_text(image, "8W", left, baseline, {10, Eigen::Array3d::Zero()});
    draw_text(image, "\xC2", 0, 4, {10, Eigen::Array3d::Zero()});  // half a character
    EXPECT_EQ(image.rgb.size(), 75u);
}

}  // namespace
}  // namespace patchlight::raster::stroke_font_test
